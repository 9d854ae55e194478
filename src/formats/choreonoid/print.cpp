// SPDX-License-Identifier: MIT
#include "formats/choreonoid/print.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>

#include "text/yaml/emit.hpp"

namespace kinefile::choreonoid {
namespace {

/// Prints the file piece by piece.
class SeqPrinter {
 public:
  SeqPrinter(text::Printer& printer, const PrintedFile& file, std::string_view line_end)
      : printer_(printer), file_(file), line_end_(line_end) {}

  void print_blocks() {
    if (file_.version == 1) {
      line(0, "# Body motion data set format version 1.0 defined by Choreonoid");
      line(0, "");
    }
    print_top(0);
    line(0, file_.components.empty() ? "components: [ ]" : "components:");
    for (const PrintedComponent& component : file_.components) {
      line(2, "-");
      print_block(component);
    }
  }

  void print_json() {
    line(0, "{");
    print_top(0);
    line(0, "\"components\": [");
    for (std::size_t i = 0; i < file_.components.size(); ++i) {
      print_json(file_.components[i]);
      line(0, i + 1 < file_.components.size() ? "}," : "}");
    }
    line(0, "] }");
  }

 private:
  void line(std::size_t indent, std::string_view text) {
    for (std::size_t i = 0; i < indent; ++i) printer_.print(' ');
    printer_.print(text);
    printer_.print(line_end_);
  }

  void lines(std::size_t indent, std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      line(indent, text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }

  /// A key of the format, in the file's spelling.
  std::string key(std::string_view camel, std::string_view snake) const {
    const std::string_view name = file_.is_snake_case ? snake : camel;
    return file_.is_json ? fmt::format("\"{}\"", name) : std::string(name);
  }
  std::string key(std::string_view name) const { return key(name, name); }

  /// A word as a value: quoted if YAML would read it as something else.
  std::string word(std::string_view text) const {
    const bool is_plain =
        !file_.is_json && !text.empty() &&
        text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") ==
            std::string_view::npos;
    return is_plain ? std::string(text) : text::json_string(text);
  }

  /// A key and its value; in block style on a separate line.
  void entry(std::size_t indent, const std::string& name, const std::string& value) {
    line(indent, fmt::format("{}: {}{}", name, value, file_.is_json ? "," : ""));
  }

  /// A rate or version: at the top of the file, Choreonoid prints fewer digits.
  std::string rate(double value, bool is_top) const {
    if (!file_.choreonoid_digits) return fmt::format("{}", value);
    return is_top ? fmt::format("{:.6g}", value) : fmt::format("{:.9g}", value);
  }

  void print_top(std::size_t indent) {
    entry(indent, key("type"), word(file_.version == 1 ? "BodyMotion" : "CompositeSeq"));
    entry(indent, key("content"), word("BodyMotion"));
    if (!file_.version_word.empty()) {
      entry(indent, key("formatVersion", "format_version"), file_.version_word);
    }
    if (!file_.components.empty()) {
      const PrintedComponent& main = main_component();
      if (main.frame_rate > 0) {
        entry(indent, key("frameRate", "frame_rate"), rate(main.frame_rate, true));
      }
      if (main.component->kind != ComponentKind::Other) {
        entry(indent, key("numFrames", "num_frames"),
              fmt::format("{}", main.component->num_frames));
      }
    }
    print_unknown(indent, file_.unknown_keys);
  }

  /// The component whose length and rate are the motion's.
  const PrintedComponent& main_component() const {
    for (const std::string_view content : {kLinkPosition, kJointDisplacement}) {
      for (const PrintedComponent& component : file_.components) {
        if (component.component->content == content) return component;
      }
    }
    return file_.components.front();
  }

  void print_unknown(std::size_t indent, const std::string& text) {
    if (text.empty()) return;
    if (!file_.is_json) {
      lines(indent, text);
      return;
    }
    for_each_pair(text, [&](const text::yaml::Node& name, const text::yaml::Node& value) {
      entry(0, text::yaml::json_key(name), text::yaml::json_text(value));
    });
  }

  /// Reads kept YAML lines again.
  template <class Use>
  static void for_each_pair(const std::string& text, const Use& use) {
    const text::Source source("", text);
    Diagnostics ignored;
    const auto tree = text::yaml::read_tree(source, ignored);
    if (tree == nullptr) return;
    const auto& children = tree->root().children;
    for (std::size_t i = 0; i + 1 < children.size(); i += 2) use(*children[i], *children[i + 1]);
  }

  void print_head(const PrintedComponent& printed, std::size_t indent) {
    const Component& component = *printed.component;
    const bool has_parts = component.kind != ComponentKind::Vectors;
    const std::string num_parts = fmt::format("{}", component.num_parts);
    entry(indent, key("type"), word(printed.type));
    entry(indent, key("content"), word(printed.content));
    // The number of parts comes first in the format's document, but later in Choreonoid's own
    // files.
    const bool has_parts_first = file_.version < 3;
    if (has_parts && has_parts_first) entry(indent, key("numParts", "num_parts"), num_parts);
    if (printed.frame_rate > 0) {
      entry(indent, key("frameRate", "frame_rate"), rate(printed.frame_rate, false));
    }
    entry(indent, key("numFrames", "num_frames"), fmt::format("{}", component.num_frames));
    if (has_parts && !has_parts_first) entry(indent, key("numParts", "num_parts"), num_parts);
    if (printed.says_relative) entry(indent, key("isRootRelative", "is_root_relative"), "true");
    if (has_own_times(component.timeline)) {
      entry(indent, key("hasFrameTime", "has_frame_time"), "true");
    }
    if (component.kind == ComponentKind::Poses) {
      entry(indent, file_.version == 1 ? key("format") : key("SE3Format"),
            word(printed.pose_format));
    }
    print_unknown(indent, printed.unknown_keys);
  }

  void print_block(const PrintedComponent& printed) {
    if (printed.component->kind == ComponentKind::Other) {
      lines(4, printed.unknown_keys);
      return;
    }
    print_head(printed, 4);
    const std::size_t num_frames = printed.component->num_frames;
    line(4, num_frames == 0 ? "frames: [ ]" : "frames:");
    print_rows(printed, [&printed](SeqPrinter& part, std::size_t f) {
      part.printer_.print("      - ");
      part.print_row(printed, f);
      part.printer_.print(part.line_end_);
    });
  }

  void print_json(const PrintedComponent& printed) {
    line(0, "{");
    if (printed.component->kind == ComponentKind::Other) {
      std::size_t num_left = 0;
      for_each_pair(printed.unknown_keys, [&](const auto&, const auto&) { ++num_left; });
      for_each_pair(printed.unknown_keys, [&](const auto& name, const auto& value) {
        --num_left;
        line(0, fmt::format("{}: {}{}", text::yaml::json_key(name), text::yaml::json_text(value),
                            num_left > 0 ? "," : ""));
      });
      return;
    }
    print_head(printed, 0);
    line(0, "\"frames\": [");
    const std::size_t num_frames = printed.component->num_frames;
    print_rows(printed, [&printed, num_frames](SeqPrinter& part, std::size_t f) {
      part.print_row(printed, f);
      if (f + 1 < num_frames) part.printer_.print(',');
      part.printer_.print(part.line_end_);
    });
    printer_.print("] ");
  }

  /// Prints all frames of a component.
  /// \param print_one  with the printer of its part, and the frame
  template <class PrintOne>
  void print_rows(const PrintedComponent& printed, const PrintOne& print_one) {
    const Component& component = *printed.component;
    printer_.print_rows(component.num_frames, component.row_size(),
                        [&](text::Printer& printer, std::size_t begin, std::size_t end) {
                          SeqPrinter part(printer, file_, line_end_);
                          for (std::size_t f = begin; f < end; ++f) print_one(part, f);
                        });
  }

  void print_row(const PrintedComponent& printed, std::size_t frame) {
    const Component& component = *printed.component;
    const bool is_pose = component.kind == ComponentKind::Poses;
    const std::size_t width = !is_pose                                        ? component.width()
                              : printed.pose_order == PoseOrder::RollPitchYaw ? 6
                                                                              : 7;
    const Array<double>& values = printed.converted.empty() ? component.values : printed.converted;
    const double* row = values.data() + frame * width * component.num_parts;
    printer_.print("[ ");
    if (has_own_times(component.timeline)) {
      print_numbers({&own_times(component.timeline)[frame], 1});
      printer_.print(", ");
    }
    if (is_pose) {
      for (std::size_t p = 0; p < component.num_parts; ++p) {
        if (p > 0) printer_.print(", ");
        print_pose({row + p * width, width}, printed.pose_order);
      }
    } else {
      print_numbers({row, width * component.num_parts});
    }
    printer_.print(" ]");
  }

  void print_pose(std::span<const double> pose, PoseOrder order) {
    printer_.print("[ ");
    if (order == PoseOrder::QuaternionWLast) {
      // w x y z of the model, and the file's x y z w
      const std::array<double, 7> w_last = {pose[0], pose[1], pose[2], pose[4],
                                            pose[5], pose[6], pose[3]};
      print_numbers(w_last);
    } else {
      print_numbers(pose);
    }
    printer_.print(" ]");
  }

  void print_numbers(std::span<const double> numbers) {
    if (!file_.choreonoid_digits) {
      printer_.print_row(numbers, ", ");
      return;
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (i > 0) printer_.print(", ");
      if (std::isfinite(numbers[i])) {
        printer_.print(fmt::format("{:.9g}", numbers[i]));
      } else {
        printer_.print(numbers[i]);
      }
    }
  }

  text::Printer& printer_;
  const PrintedFile& file_;
  std::string_view line_end_;
};

}  // namespace

void print_file(text::Printer& printer, const PrintedFile& file, std::string_view line_end) {
  SeqPrinter seq(printer, file, line_end);
  if (file.is_json) {
    seq.print_json();
  } else {
    seq.print_blocks();
  }
}

}  // namespace kinefile::choreonoid
