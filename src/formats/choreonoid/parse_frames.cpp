// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "formats/choreonoid/codes.hpp"
#include "formats/choreonoid/reader.hpp"
#include "formats/quaternion_faults.hpp"
#include "text/numbers.hpp"

namespace kinefile::choreonoid {
namespace {

using text::quoted;
using text::yaml::Node;
using text::yaml::NodeKind;
using text::yaml::RowEntries;
using text::yaml::RowShape;

/// More parts than any file has; with more than this, no frames are read (see `parse_frames`).
constexpr std::size_t kMostParts = std::size_t{1} << 30;

/// The largest number of parts if the frames contain no numbers.
constexpr std::size_t kMostUnseenParts = 10'000;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A whole number of hexadecimal digits, "0x1F".
std::optional<double> parse_hexadecimal(std::string_view text) {
  const bool is_negative = text.starts_with('-');
  if (is_negative || text.starts_with('+')) text.remove_prefix(1);
  if ((!text.starts_with("0x") && !text.starts_with("0X")) || text.size() < 3) return std::nullopt;
  double value = 0;
  for (const char c : text.substr(2)) {
    const int digit = c >= '0' && c <= '9'   ? c - '0'
                      : c >= 'a' && c <= 'f' ? c - 'a' + 10
                      : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                             : -1;
    if (digit < 0) return std::nullopt;
    value = value * 16 + digit;
  }
  return is_negative ? -value : value;
}

/// The number at the start of a text, as C's strtod reads it.
std::optional<double> leading_number(std::string_view text) {
  for (std::size_t length = std::min<std::size_t>(text.size(), 400); length > 0; --length) {
    const auto number = text::parse_number(text.substr(0, length));
    if (number.fault == text::NumberFault::None && std::isfinite(number.value)) return number.value;
  }
  return std::nullopt;
}

/// YAML's own words for values that are not finite.
std::optional<double> parse_yaml_word(std::string_view text) {
  const bool is_negative = text.starts_with("-.");
  if (is_negative || text.starts_with("+.")) text.remove_prefix(1);
  if (text == ".inf" || text == ".Inf" || text == ".INF")
    return is_negative ? -kInfinity : kInfinity;
  if (text == ".nan" || text == ".NaN" || text == ".NAN") return std::nan("");
  return std::nullopt;
}

/// The largest possible count of numbers in the first frame; 0 if it is not a list.
std::size_t numbers_in_first_frame(const Reader& reader, const Node& frames) {
  const Node* first = frames.children.empty() ? nullptr : frames.children.front();
  if (frames.rows) {
    const RowEntries::Entry& entry = frames.rows->entries.front();
    if (entry.node == nullptr) return reader.tree.num_values(entry.shape);
    first = entry.node;
  }
  return first == nullptr || first->kind != NodeKind::Sequence ? 0 : first->size;
}

const char* first_frame(const Node& frames) {
  if (!frames.rows && frames.children.empty()) return frames.at;
  if (!frames.rows) return frames.children.front()->at;
  const RowEntries::Entry& entry = frames.rows->entries.front();
  return entry.node == nullptr ? entry.text.data() : entry.node->at;
}

/// Reads the frames of one component.
class FrameReader {
 public:
  FrameReader(const Reader& reader, SeqComponent& component)
      : reader_(reader), component_(component), width_(width_of(component)) {
    const auto width = static_cast<std::int32_t>(width_);
    const auto parts = static_cast<std::int32_t>(component.num_parts);
    if (component.num_parts > kMostParts) return;  // without frames
    if (component.has_times) shape_.push_back(1);
    if (component.kind == ComponentKind::Poses) {
      shape_.insert(shape_.end(), component.num_parts, -width);
    } else if (component.has_times) {
      shape_[0] += parts * width;
    } else {
      shape_.push_back(parts * width);
    }
  }

  void read(const Node& frames) {
    if (frames.rows) {
      read_rows(frames);
    } else {
      component_.values.reserve(
          std::min(frames.children.size() * component_.num_parts * width_, frames.size));
      for (const Node* frame : frames.children) read_node(*frame);
    }
    tell_quaternion_faults(reader_.source, faults_, component_.content,
                           {code::kNoRotation, code::kOtherLength}, reader_.diagnostics);
  }

 private:
  void read_rows(const Node& frames) {
    const std::unique_ptr<RowEntries> rows = reader_.tree.take_rows(frames);
    if (!component_.has_times && all_fit(*rows)) {
      component_.values = std::move(rows->values);
      component_.num_frames = rows->entries.size();
      for (std::size_t f = 0; f < component_.num_frames && has_quaternions(); ++f) {
        look_at_quaternions(row_of(f), f, rows->entries[f].text.data(), faults_);
      }
      return;
    }
    component_.values.reserve(rows->values.size());
    const double* next = rows->values.data();
    for (const RowEntries::Entry& entry : rows->entries) {
      if (entry.node != nullptr) {
        read_node(*entry.node);
        continue;
      }
      const std::size_t size = reader_.tree.num_values(entry.shape);
      read_row(entry, {next, size});
      next += size;
    }
  }

  bool all_fit(const RowEntries& rows) const {
    const std::uint32_t shape = rows.entries.front().shape;
    return std::all_of(rows.entries.begin(), rows.entries.end(),
                       [shape](const auto& entry) {
                         return entry.node == nullptr && entry.shape == shape;
                       }) &&
           reader_.tree.shape(shape) == shape_;
  }

  void read_row(const RowEntries::Entry& entry, std::span<const double> values) {
    const char* at = entry.text.data();
    const RowShape& shape = reader_.tree.shape(entry.shape);
    if (shape != shape_ && !is_flat_pose(shape, at)) {
      report_shape(shape, at);
      return;
    }
    if (component_.has_times) {
      add_time(values[0], at);
      values = values.subspan(1);
    }
    add_frame(values, at);
  }

  void add_frame(std::span<const double> values, const char* at) {
    if (has_quaternions()) look_at_quaternions(values, component_.num_frames, at, faults_);
    component_.values.append(values);
    ++component_.num_frames;
  }

  bool has_quaternions() const {
    return component_.kind == ComponentKind::Poses &&
           component_.pose_order != PoseOrder::RollPitchYaw;
  }

  std::span<const double> row_of(std::size_t frame) const {
    const std::size_t size = component_.num_parts * width_;
    return {component_.values.data() + frame * size, size};
  }

  /// Whether a single pose lacks the brackets of the list around it.
  bool is_flat_pose(const RowShape& shape, const char* at) const {
    if (component_.kind != ComponentKind::Poses || component_.num_parts != 1) return false;
    const auto size = static_cast<std::int32_t>(width_ + (component_.has_times ? 1 : 0));
    if (shape != RowShape{size}) return false;
    return reader_.repair(code::kBadFrame, "expected a list of poses, found one pose alone",
                          "it is read as a list of one", at);
  }

  void report_shape(const RowShape& shape, const char* at) const {
    const bool is_flat_pose =
        component_.kind == ComponentKind::Poses && component_.num_parts == 1 &&
        shape == RowShape{static_cast<std::int32_t>(width_ + (component_.has_times ? 1 : 0))};
    if (is_flat_pose) return;  // has been reported
    reader_.error(code::kBadFrame,
                  fmt::format("expected {}, found {}", words_of(shape_), words_of(shape)), at);
  }

  /// A shape as text: "a time and 2 poses of 7 numbers each".
  static std::string words_of(const RowShape& shape) {
    const auto numbers = [](std::int64_t count) {
      return fmt::format("{} number{}", count, count == 1 ? "" : "s");
    };
    std::string text;
    for (std::size_t i = 0; i < shape.size();) {
      std::size_t same = i + 1;
      while (same < shape.size() && shape[same] == shape[i]) ++same;
      const std::size_t count = same - i;
      if (!text.empty()) text += " and ";
      if (shape[i] > 0) {
        text += numbers(std::int64_t{shape[i]});
      } else {
        const std::int64_t size = shape[i] == text::yaml::kEmptyGroup ? 0 : -std::int64_t{shape[i]};
        text += count == 1 ? fmt::format("a list of {}", numbers(size))
                           : fmt::format("{} lists of {} each", count, numbers(size));
      }
      i = same;
    }
    return text.empty() ? "nothing" : text;
  }

  /// Reads a frame that is not a row of plain numbers.
  void read_node(const Node& frame) {
    if (frame.kind != NodeKind::Sequence) {
      reader_.error(code::kBadFrame,
                    fmt::format("expected a list of {}, found {}", words_of(shape_),
                                frame.kind == NodeKind::Scalar ? quoted(frame.text) : "a mapping"),
                    frame.at);
      return;
    }
    RowShape shape;
    std::vector<double> values;
    if (!collect(frame, shape, values, true)) return;
    if (shape != shape_ && !is_flat_pose(shape, frame.at)) {
      report_shape(shape, frame.at);
      return;
    }
    std::span<const double> rest(values);
    if (component_.has_times) {
      add_time(rest[0], frame.at);
      rest = rest.subspan(1);
    }
    add_frame(rest, frame.at);
  }

  /// Collects the numbers of a frame and its shape. False after an error.
  bool collect(const Node& list, RowShape& shape, std::vector<double>& values, bool is_outer) {
    if (list.rows) return collect_rows(list, shape, values, is_outer);
    bool is_good = true;
    std::int32_t count = 0;
    const auto finish_count = [&] {
      if (is_outer && count > 0) shape.push_back(count);
      count = 0;
    };
    for (const Node* child : list.children) {
      if (child->kind == NodeKind::Sequence && is_outer) {
        finish_count();
        is_good &= collect(*child, shape, values, false);
        continue;
      }
      const auto number = read_number(reader_, *child);
      is_good &= number.has_value();
      values.push_back(number.value_or(0));
      ++count;
    }
    if (is_outer) {
      finish_count();
    } else {
      shape.push_back(count == 0 ? text::yaml::kEmptyGroup : -count);
    }
    return is_good;
  }

  /// Collects a frame that is a block list whose poses are rows.
  bool collect_rows(const Node& list, RowShape& shape, std::vector<double>& values, bool is_outer) {
    bool is_good = is_outer;
    const double* next = list.rows->values.data();
    for (const RowEntries::Entry& entry : list.rows->entries) {
      if (entry.node != nullptr) {
        if (entry.node->kind == NodeKind::Sequence) {
          is_good &= collect(*entry.node, shape, values, false);
        } else {
          const auto number = read_number(reader_, *entry.node);
          is_good &= number.has_value();
          values.push_back(number.value_or(0));
          if (!shape.empty() && shape.back() > 0) {
            ++shape.back();
          } else {
            shape.push_back(1);
          }
        }
        continue;
      }
      const RowShape& inner = reader_.tree.shape(entry.shape);
      const std::size_t size = reader_.tree.num_values(entry.shape);
      is_good &= inner.size() <= 1 && (inner.empty() || inner[0] > 0);
      shape.push_back(inner.empty() ? text::yaml::kEmptyGroup : -inner[0]);
      values.insert(values.end(), next, next + size);
      next += size;
    }
    if (!is_good) {
      reader_.error(
          code::kBadFrame,
          fmt::format("expected a list of {}, found lists within lists", words_of(shape_)),
          list.at);
    }
    return is_good;
  }

  void add_time(double time, const char* at) {
    component_.times.push_back(time);
    component_.time_places.push_back(at);
  }

  const Reader& reader_;
  SeqComponent& component_;
  std::size_t width_;
  RowShape shape_;  ///< of a correct frame
  QuaternionFaults faults_;
};

}  // namespace

std::size_t width_of(const SeqComponent& component) {
  if (component.kind == ComponentKind::Vectors) return 3;
  if (component.kind != ComponentKind::Poses) return 1;
  return component.pose_order == PoseOrder::RollPitchYaw ? 6 : 7;
}

bool Reader::repair(const char* code, std::string message, std::string_view repair,
                    const char* at) const {
  if (options.lenient) message += fmt::format("; {}", repair);
  tell(options.lenient ? Severity::Warning : Severity::Error, code, std::move(message), at);
  return options.lenient;
}

void Reader::warn_rejected(std::string_view why, const char* at) const {
  warn(code::kChoreonoidRejects, fmt::format("Choreonoid 2.x will reject this: {}", why), at);
}

std::optional<double> read_number(const Reader& reader, const Node& node) {
  if (node.kind != NodeKind::Scalar) {
    reader.error(code::kNotANumber,
                 fmt::format("expected a number, found a {}",
                             node.kind == NodeKind::Sequence ? "list" : "mapping"),
                 node.at);
    return std::nullopt;
  }
  const auto number = text::parse_number(node.text);
  if (number.fault == text::NumberFault::None) {
    if (!std::isfinite(number.value)) {
      reader.warn(code::kNotFinite,
                  fmt::format("expected a finite number, found {}", quoted(node.text)), node.at);
    }
    return number.value;
  }
  if (number.fault == text::NumberFault::OutOfRange) {
    reader.warn(code::kNotFinite,
                fmt::format("expected a number that a double holds, found {}; it is read as "
                            "infinite",
                            quoted(node.text)),
                node.at);
    return node.text.starts_with('-') ? -kInfinity : kInfinity;
  }
  if (const auto hexadecimal = parse_hexadecimal(node.text)) return hexadecimal;
  if (const auto word = parse_yaml_word(node.text)) {
    reader.warn_rejected(
        fmt::format("{} is YAML's word for what it calls nan or inf", quoted(node.text)), node.at);
    return word;
  }
  const std::string found = node.text.empty() ? "nothing" : quoted(node.text);
  const auto leading = leading_number(node.text);
  if (!leading) {
    reader.error(code::kNotANumber, fmt::format("expected a number, found {}", found), node.at);
    return std::nullopt;
  }
  if (!reader.repair(code::kNotANumber, fmt::format("expected a number, found {}", found),
                     fmt::format("it is read as {}, as Choreonoid does", *leading), node.at)) {
    return std::nullopt;
  }
  return leading;
}

void parse_frames(const Reader& reader, const Node& frames, SeqComponent& component) {
  // A count in the file is not trusted: memory is not allocated by it.
  const std::size_t num_numbers = numbers_in_first_frame(reader, frames);
  if (component.num_parts > (num_numbers > 0 ? num_numbers : kMostUnseenParts)) {
    reader.error(code::kBadFrame,
                 fmt::format("expected frames of {} parts, found {}", component.num_parts,
                             num_numbers > 0 ? fmt::format("one of {} numbers", num_numbers)
                                             : std::string("no numbers")),
                 first_frame(frames));
    return;
  }
  FrameReader(reader, component).read(frames);
}

}  // namespace kinefile::choreonoid
