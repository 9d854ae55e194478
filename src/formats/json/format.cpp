// SPDX-License-Identifier: MIT
#include "formats/json/format.hpp"

#include <array>

#include "formats/common_options.hpp"
#include "formats/files.hpp"
#include "formats/json/flow.hpp"
#include "formats/json/pose_table.hpp"
#include "formats/json/writer.hpp"

namespace kinefile::json {
namespace {

constexpr std::array<std::string_view, 1> kExtensions = {".json"};
constexpr std::array<WriteOption, 1> kWriteOptions = {options::kDecimals};

std::string_view dof_kind_name(DofKind kind) {
  switch (kind) {
    case DofKind::Rotation:
      return "rotation";
    case DofKind::Translation:
      return "translation";
    case DofKind::Free:
      return "free";
    case DofKind::Ball:
      return "ball";
    case DofKind::RotationVector:
      return "rotation_vector";
    case DofKind::TailTranslation:
      return "tail_translation";
    case DofKind::TailScale:
      return "tail_scale";
  }
  return "";
}

std::span<const double> numbers_of(const Vec3& v) { return {v.data(), 3}; }

void print_dof(text::Printer& printer, const DegreeOfFreedom& dof) {
  printer.print("{\"kind\":\"");
  printer.print(dof_kind_name(dof.kind));
  printer.print("\",\"axis\":");
  print_array(printer, numbers_of(dof.axis));
  printer.print(fmt::format(",\"column\":{},\"rest\":", dof.coordinate));
  printer.print(dof.rest);
  if (!is_plain(dof)) {
    printer.print(",\"gain\":");
    printer.print(dof.gain);
    printer.print(",\"shift\":");
    printer.print(dof.shift);
  }
  printer.print('}');
}

void print_tip(text::Printer& printer, const Tip& tip) {
  printer.print("{\"name\":");
  printer.print(text::json_string(tip.name));
  printer.print(",\"offset\":");
  print_array(printer, numbers_of(tip.offset));
  printer.print('}');
}

void print_joint(text::Printer& printer, const Skeleton& skeleton, const Joint& joint) {
  printer.print("{\"name\":");
  printer.print(text::json_string(joint.name));
  printer.print(",\"parent\":");
  printer.print(joint.parent == kNoParent ? "null"
                                          : text::json_string(skeleton.joints[joint.parent].name));
  printer.print(",\"offset\":");
  print_array(printer, numbers_of(joint.offset));
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
    printer.print(skeleton.metres_per_unit);
  } else {
    printer.print("null");
  }
  printer.print(",\"joints\":");
  print_elements(printer, skeleton.joints.size(), ",\n  ",
                 [&](std::size_t j) { print_joint(printer, skeleton, skeleton.joints[j]); });
  printer.print('}');
}

/// \param frames  of the motion, whose own clip has a timeline at the least
Result<void> print_clip(text::Printer& printer, const Motion& motion, EachBlock frames) {
  printer.print(",\n\"frame_time\":");
  printer.print_exact(frame_time(motion.clip.timeline));
  if (has_own_times(motion.clip.timeline)) {
    printer.print(",\n\"times\":");
    print_array(printer, own_times(motion.clip.timeline));
  }
  printer.print(",\n\"columns\":");
  const std::vector<std::string> names = column_names(motion.skeleton);
  print_elements(printer, names.size(), ",",
                 [&](std::size_t i) { printer.print(text::json_string(names[i])); });
  printer.print(",\n\"values\":[");
  const std::size_t num_columns = motion.skeleton.coordinates.size();
  auto printed = frames([&](const FrameBlock& block) {
    const auto print = [&](text::Printer& part, std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        if (block.first_frame + f > 0) part.print(",\n  ");
        print_array(part, block.rows.subspan(f * num_columns, num_columns));
      }
    };
    printer.print_rows(block.num_frames, num_columns, print);
    return printer.is_good();
  });
  printer.print(']');
  return printed;
}

std::string_view type_name(ComponentKind kind) {
  constexpr std::array<std::string_view, 4> kNames = {"MultiValueSeq", "MultiSE3Seq", "Vector3Seq",
                                                      ""};
  return kNames[static_cast<std::size_t>(kind)];
}

/// Prints a frame: numbers for values and vectors, arrays for poses with their quaternions.
void print_frame(text::Printer& printer, const Component& component, std::size_t frame) {
  const auto row = component.row(frame);
  if (component.kind != ComponentKind::Poses) {
    print_array(printer, row);
    return;
  }
  print_elements(printer, component.num_parts, ",", [&](std::size_t part) {
    const auto pose = row.subspan(part * component.width(), component.width());
    const auto q = quaternion_of_pose(component.pose_form, pose);
    print_array(printer, std::array<double, 7>{pose[0], pose[1], pose[2], q[0], q[1], q[2], q[3]});
  });
}

void print_component(text::Printer& printer, const Component& component) {
  printer.print("{\"type\":");
  printer.print(text::json_string(type_name(component.kind)));
  printer.print(",\"content\":");
  printer.print(text::json_string(component.content));
  printer.print(",\"frame_rate\":");
  printer.print(nominal_frame_rate(component.timeline));
  printer.print(fmt::format(",\"num_parts\":{}", component.num_parts));
  if (component.kind == ComponentKind::Poses) printer.print(",\"se3_format\":\"XYZQWQXQYQZ\"");
  printer.print(",\"is_root_relative\":");
  printer.print(component.is_root_relative ? "true" : "false");
  if (has_own_times(component.timeline)) {
    printer.print(",\"times\":");
    print_array(printer, own_times(component.timeline));
  }
  printer.print(",\"frames\":");
  print_rows(printer, component.num_frames, component.row_size(),
             [&](text::Printer& part, std::size_t f) { print_frame(part, component, f); });
  printer.print('}');
}

/// Prints the components whose frames kinefile interprets.
void print_body_motion(text::Printer& printer, const BodyMotion& motion, Diagnostics& diagnostics) {
  std::vector<const Component*> known;
  for (const Component& component : motion.components) {
    if (component.kind != ComponentKind::Other) known.push_back(&component);
  }
  if (known.size() < motion.components.size()) {
    diagnostics.add(Severity::Warning, "JSN001", "components of unknown type are left out");
  }
  printer.print("{\"components\":");
  print_elements(printer, known.size(), ",\n",
                 [&](std::size_t i) { print_component(printer, *known[i]); });
  printer.print("}\n");
}

Result<void> print_motion(text::Printer& printer, const Document& document, EachBlock frames) {
  printer.print("{\"skeleton\":");
  print_skeleton(printer, skeleton_of(document));
  const Motion* const motion = std::get_if<Motion>(&document.content);
  auto printed = motion == nullptr ? Result<void>() : print_clip(printer, *motion, frames);
  printer.print("}\n");
  return printed;
}

Result<void> write(const Document& document, const WriteOptions& options, const Sink& sink,
                   Diagnostics& diagnostics) {
  if (auto valid = validate(document); !valid) return valid;
  text::Printer printer(sink, number_spelling(options.decimals));
  Result<void> printed;
  if (const BodyMotion* body = std::get_if<BodyMotion>(&document.content)) {
    print_body_motion(printer, *body, diagnostics);
  } else if (const PoseFlow* flow = std::get_if<PoseFlow>(&document.content)) {
    print_flow(printer, *flow);
  } else {
    const Motion* const motion = std::get_if<Motion>(&document.content);
    printed = print_motion(printer, document,
                           [motion](UseBlock use) { return for_each_block(motion->clip, use); });
  }
  return finish(printer, std::move(printed));
}

Result<void> write_frames(const LongMotion& motion, const WriteOptions& options, const Sink& sink,
                          Diagnostics&) {
  text::Printer printer(sink, number_spelling(options.decimals));
  auto printed = print_motion(printer, motion.document, [&motion](UseBlock use) {
    return for_each_block(motion.frames, use);
  });
  return finish(printer, std::move(printed));
}

}  // namespace

Format format() {
  Format format;
  format.name = "json";
  format.description = "JSON: skeleton, column names and values";
  format.extensions = kExtensions;
  format.write = write;
  if (kReadsInBlocks) format.write_frames = write_frames;
  format.conventions.writes = {
      .motions = true, .skeletons = true, .body_motions = true, .flows = true};
  format.write_poses = write_poses;
  format.write_options = kWriteOptions;
  format.conventions.keeps_times = true;
  return format;
}

}  // namespace kinefile::json
