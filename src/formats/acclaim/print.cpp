// SPDX-License-Identifier: MIT
#include "formats/acclaim/print.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace kinefile::acclaim {
namespace {

struct Writer {
  text::Printer& printer;
  std::string_view line_end;

  void line(std::string_view text) {
    printer.print(text);
    printer.print(line_end);
  }
  /// Lines that were kept unchanged, with any line ends.
  void lines(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
      line(text.substr(0, end));
      const bool is_last = end == text.size();
      text.remove_prefix(end);
      if (text.starts_with('\r')) text.remove_prefix(1);
      if (text.starts_with('\n')) text.remove_prefix(1);
      if (text.empty() && !is_last) line({});  // an empty one
    }
  }
};

std::string joined(const std::array<double, 3>& numbers) {
  return fmt::format("{} {} {}", numbers[0], numbers[1], numbers[2]);
}

void print_root(Writer& writer, const Root& root) {
  writer.line(":root");
  std::string order = "   order";
  for (const DofWord word : root.order) {
    order += ' ';
    for (const char c : spelling(word)) order += static_cast<char>(c - 'a' + 'A');
  }
  writer.line(order);
  writer.line("   axis " + spelling(root.orientation.order));
  writer.line("   position " + joined(root.position));
  writer.line("   orientation " + joined(root.orientation.angles));
}

void print_dofs(Writer& writer, const Bone& bone) {
  if (bone.dofs.empty()) return;
  std::string dofs = "     dof";
  for (const DofWord word : bone.dofs) dofs += fmt::format(" {}", spelling(word));
  writer.line(dofs);
  for (std::size_t i = 0; i < bone.limits.size(); ++i) {
    writer.line(fmt::format("     {} ({} {})", i == 0 ? "limits" : "      ", bone.limits[i].low,
                            bone.limits[i].high));
  }
}

void print_bone(Writer& writer, const Bone& bone, const std::string& id) {
  writer.line("  begin");
  writer.line("     id " + id);
  writer.line("     name " + bone.name);
  writer.line("     direction " + joined(bone.direction));
  writer.line(fmt::format("     length {}", bone.length));
  writer.line(fmt::format("     axis {} {}", joined(bone.axis.angles), spelling(bone.axis.order)));
  // Before the limits, because a following line that starts with a number would continue them.
  for (const std::string& other : bone.other_lines) writer.line("     " + other);
  print_dofs(writer, bone);
  if (!bone.body_mass.empty()) writer.line("     bodymass " + bone.body_mass);
  if (!bone.cof_mass.empty()) writer.line("     cofmass " + bone.cof_mass);
  writer.line("  end");
}

/// The ids of all bones: their own, otherwise unused numbers.
std::vector<std::string> ids_of_bones(const AsfFile& file) {
  std::set<std::string> used;
  for (const Bone& bone : file.bones) used.insert(bone.id);
  std::vector<std::string> ids;
  std::size_t next = 1;
  for (const Bone& bone : file.bones) {
    ids.push_back(bone.id);
    while (ids.back().empty()) {
      std::string id = std::to_string(next++);
      if (used.insert(id).second) ids.back() = std::move(id);
    }
  }
  return ids;
}

void print_hierarchy(Writer& writer, const AsfFile& file) {
  std::vector<std::string> children(file.bones.size() + 1);  // of the root, then of each bone
  for (const Bone& bone : file.bones) {
    children[bone.parent == kNoParent ? 0 : bone.parent + 1] += ' ' + bone.name;
  }
  writer.line(":hierarchy");
  writer.line("  begin");
  for (std::size_t p = 0; p < children.size(); ++p) {
    if (children[p].empty()) continue;
    const std::string parent = p == 0 ? "root" : file.bones[p - 1].name;
    writer.line("    " + parent + children[p]);
  }
  writer.line("  end");
}

std::string_view angle_word(AngleUnit unit) { return unit == AngleUnit::Degrees ? "deg" : "rad"; }

}  // namespace

void print_asf(text::Printer& printer, const AsfFile& file, std::string_view line_end) {
  Writer writer{printer, line_end};
  writer.lines(file.comments.empty() ? "# Acclaim skeleton, written by kinefile" : file.comments);
  writer.line(":version " + (file.version.empty() ? std::string("1.10") : file.version));
  writer.line(":name " + (file.name.empty() ? std::string("skeleton") : file.name));
  writer.line(":units");
  writer.line(fmt::format("  mass {}", file.mass.value_or(1.0)));
  if (file.length) writer.line(fmt::format("  length {}", *file.length));
  writer.line(fmt::format("  angle {}", angle_word(file.angle.value_or(AngleUnit::Degrees))));
  if (!file.documentation.empty()) {
    writer.line(":documentation");
    writer.lines(file.documentation);
  }
  print_root(writer, file.root);
  writer.line(":bonedata");
  const std::vector<std::string> ids = ids_of_bones(file);
  for (std::size_t b = 0; b < file.bones.size(); ++b) print_bone(writer, file.bones[b], ids[b]);
  print_hierarchy(writer, file);
  if (!file.skin.empty()) {
    writer.line(":skin");
    writer.lines(file.skin);
  }
  writer.lines(file.other_sections);
}

namespace {

/// The lines of a frame: 0 is the root, 1 the first bone. Bones without values have no line.
std::vector<std::size_t> line_order(const Unbound& unbound,
                                    const std::vector<std::string>& bone_order) {
  std::vector<std::size_t> usual;
  for (std::size_t i = 0; i < unbound.columns.size(); ++i) {
    if (!unbound.columns[i].empty()) usual.push_back(i);
  }
  std::map<std::string_view, std::size_t> waiting;
  for (const std::size_t i : usual) {
    waiting.emplace(i == 0 ? std::string_view("root") : unbound.file.bones[i - 1].name, i);
  }
  std::vector<std::size_t> kept;
  for (const std::string& name : bone_order) {
    const auto found = waiting.find(name);
    if (found == waiting.end()) return usual;
    kept.push_back(found->second);
    waiting.erase(found);
  }
  return waiting.empty() ? kept : usual;
}

void print_heading(Writer& writer, const Unbound& unbound, const AmcHeading& heading,
                   const Timeline& timeline) {
  if (!heading.skeleton.empty()) writer.line("#!OML:ASF " + heading.skeleton);
  writer.lines(heading.other_lines);
  writer.line(":FULLY-SPECIFIED");
  writer.line(heading.angle == AngleUnit::Degrees ? ":DEGREES" : ":RADIANS");
  if (unbound.forces_3dof) writer.line(":FORCE-ALL-JOINTS-BE-3DOF");
  if (heading.says_rate) {
    writer.line(fmt::format(":SAMPLES-PER-SECOND {}", frame_rate(timeline)));
  }
}

/// Prints a line for each bone in this order.
void print_frame(text::Printer& printer, const Unbound& unbound,
                 const std::vector<std::size_t>& order, std::span<const double> row,
                 std::string_view line_end) {
  std::vector<double> numbers;
  for (const std::size_t i : order) {
    printer.print(i == 0 ? std::string_view("root") : unbound.file.bones[i - 1].name);
    numbers.clear();
    for (const std::size_t c : unbound.columns[i]) numbers.push_back(row[c]);
    printer.continue_row(numbers, " ");
    printer.print(line_end);
  }
}

}  // namespace

Result<void> print_amc(text::Printer& printer, const Unbound& unbound, const AmcHeading& heading,
                       const Timeline& timeline, std::size_t num_columns, EachBlock frames,
                       std::string_view line_end) {
  Writer writer{printer, line_end};
  print_heading(writer, unbound, heading, timeline);
  const std::vector<std::size_t> order = line_order(unbound, heading.bone_order);
  return frames([&](const FrameBlock& block) {
    const std::int64_t number =
        heading.first_frame_number + static_cast<std::int64_t>(block.first_frame);
    const auto print = [&](text::Printer& part, std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        part.print(std::to_string(number + static_cast<std::int64_t>(f)));
        part.print(line_end);
        print_frame(part, unbound, order, block.rows.subspan(f * num_columns, num_columns),
                    line_end);
      }
    };
    printer.print_rows(block.num_frames, num_columns, print);
    return printer.is_good();
  });
}

}  // namespace kinefile::acclaim
