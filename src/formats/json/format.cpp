// SPDX-License-Identifier: MIT
#include "formats/json/format.hpp"

#include <array>

#include "formats/json/writer.hpp"

namespace kinefile::json {
namespace {

constexpr std::array<std::string_view, 1> kExtensions = {".json"};

std::string_view dof_kind_name(DofKind kind) {
  switch (kind) {
    case DofKind::Rotation:
      return "rotation";
    case DofKind::Translation:
      return "translation";
    case DofKind::Free:
      return "free";
    case DofKind::TailTranslation:
      return "tail_translation";
    case DofKind::TailScale:
      return "tail_scale";
  }
  return "";
}

void print_dof(text::Printer& printer, const DegreeOfFreedom& dof) {
  printer.print("{\"kind\":\"");
  printer.print(dof_kind_name(dof.kind));
  printer.print("\",\"axis\":");
  print_array(printer, dof.axis);
  printer.print(fmt::format(",\"column\":{},\"rest\":", dof.coordinate));
  print_number(printer, dof.rest);
  printer.print('}');
}

void print_tip(text::Printer& printer, const Tip& tip) {
  printer.print("{\"name\":");
  printer.print(text::json_string(tip.name));
  printer.print(",\"offset\":");
  print_array(printer, tip.offset);
  printer.print('}');
}

void print_joint(text::Printer& printer, const Skeleton& skeleton, const Joint& joint) {
  printer.print("{\"name\":");
  printer.print(text::json_string(joint.name));
  printer.print(",\"parent\":");
  printer.print(joint.parent == kNoParent ? "null"
                                          : text::json_string(skeleton.joints[joint.parent].name));
  printer.print(",\"offset\":");
  print_array(printer, joint.offset);
  const Quat& q = joint.rest_rotation;
  printer.print(",\"rest_rotation\":");
  print_array(printer, std::array<double, 4>{q.w(), q.x(), q.y(), q.z()});
  printer.print(",\"dofs\":");
  print_elements(printer, joint.dofs.size(), ",",
                 [&](std::size_t i) { print_dof(printer, joint.dofs[i]); });
  printer.print(",\"tips\":");
  print_elements(printer, joint.tips.size(), ",",
                 [&](std::size_t i) { print_tip(printer, joint.tips[i]); });
  printer.print('}');
}

void print_skeleton(text::Printer& printer, const Skeleton& skeleton) {
  printer.print("{\"angle_unit\":\"");
  printer.print(skeleton.angle_unit == AngleUnit::Degrees ? "degrees" : "radians");
  printer.print("\",\"metres_per_unit\":");
  if (skeleton.metres_per_unit > 0) {
    print_number(printer, skeleton.metres_per_unit);
  } else {
    printer.print("null");
  }
  printer.print(",\"joints\":");
  print_elements(printer, skeleton.joints.size(), ",\n  ",
                 [&](std::size_t j) { print_joint(printer, skeleton, skeleton.joints[j]); });
  printer.print('}');
}

void print_clip(text::Printer& printer, const Motion& motion) {
  printer.print(",\n\"frame_time\":");
  printer.print_exact(frame_time(motion.clip.timeline));
  printer.print(",\n\"columns\":");
  const std::vector<std::string> names = column_names(motion.skeleton);
  print_elements(printer, names.size(), ",",
                 [&](std::size_t i) { printer.print(text::json_string(names[i])); });
  printer.print(",\n\"values\":");
  print_elements(printer, motion.clip.num_frames, ",\n  ",
                 [&](std::size_t f) { print_array(printer, motion.clip.row(f)); });
}

Result<void> write(const Document& document, const WriteOptions& options, const Sink& sink,
                   Diagnostics&) {
  text::Printer printer(sink, options.decimals);
  printer.print("{\"skeleton\":");
  print_skeleton(printer, skeleton_of(document));
  if (const Motion* motion = std::get_if<Motion>(&document.content)) print_clip(printer, *motion);
  printer.print("}\n");
  if (!printer.finish()) return fail(make_error(ErrorKind::Io, "IO003", "the output was cut off"));
  return {};
}

}  // namespace

Format format() {
  return {"json", "JSON: skeleton, column names and values", kExtensions, {}, nullptr, nullptr,
          write};
}

}  // namespace kinefile::json
