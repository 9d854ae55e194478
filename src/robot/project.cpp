// SPDX-License-Identifier: MIT
// Motions as body motions: links in the world, or a root and its joints.

#include <fmt/format.h>

#include <algorithm>

#include "kinefile/robot.hpp"
#include "kinematics/joint_columns.hpp"
#include "robot/robot.hpp"

namespace kinefile::robot {
namespace {

Component component_like(ComponentKind kind, std::string_view content, const Motion& motion,
                         std::size_t num_parts) {
  Component component;
  component.kind = kind;
  component.content = content;
  component.num_parts = num_parts;
  component.num_frames = motion.clip.num_frames;
  component.timeline = motion.clip.timeline;
  component.values.reserve(component.num_frames * component.row_size());
  return component;
}

double metres_per_unit(const Skeleton& skeleton) {
  return skeleton.metres_per_unit > 0 ? skeleton.metres_per_unit : 1.0;
}

/// The factors that convert a robot's columns to metres and radians; shape (columns).
std::vector<double> factors_of_columns(const Skeleton& skeleton) {
  std::vector<double> factors(skeleton.coordinates.size(), 1.0);
  for (const Joint& joint : skeleton.joints) {
    for (const DegreeOfFreedom& dof : joint.dofs) {
      const bool is_angle = dof.kind == DofKind::Rotation;
      const double factor = is_angle ? radians_per(skeleton.angle_unit) : metres_per_unit(skeleton);
      const std::size_t count = dof.kind == DofKind::Free ? 3 : 1;  // its quaternion has no unit
      std::fill_n(factors.begin() + static_cast<std::ptrdiff_t>(dof.coordinate), count, factor);
    }
  }
  return factors;
}

Component links_of(const Motion& motion) {
  const double scale = metres_per_unit(motion.skeleton);
  Component links =
      component_like(ComponentKind::Poses, kLinkPosition, motion, motion.skeleton.joints.size());
  std::vector<Quat> before(links.num_parts, Quat::Identity());
  const std::size_t block = frames_per_block(motion.skeleton);
  for (std::size_t first = 0; first < motion.clip.num_frames; first += block) {
    const WorldPoses poses =
        forward_kinematics(motion.skeleton, motion.clip,
                           {.first_frame = first, .num_frames = block, .rotations = true});
    for (std::size_t i = 0; i < poses.num_frames * poses.num_joints; ++i) {
      const double* p = poses.positions.data() + i * 3;
      const double* r = poses.rotations.data() + i * 4;
      Quat& last = before[i % poses.num_joints];
      last = on_side_of(Quat(r[0], r[1], r[2], r[3]), last);
      const double numbers[] = {p[0] * scale, p[1] * scale, p[2] * scale, last.w(),
                                last.x(),     last.y(),     last.z()};
      links.values.append(numbers);
    }
  }
  return links;
}

/// A range of columns as a component, in metres and radians.
Component columns_of(const Motion& motion, std::size_t begin, std::size_t end,
                     Component component) {
  const std::vector<double> factors = factors_of_columns(motion.skeleton);
  for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
    const auto row = motion.clip.row(f).subspan(begin, end - begin);
    const std::span<double> values = component.values.grow(row.size());
    for (std::size_t c = 0; c < row.size(); ++c) values[c] = row[c] * factors[begin + c];
  }
  return component;
}

}  // namespace

Result<BodyMotion> project(const Motion& motion, BodyForm form, const BodyMotion* other,
                           Diagnostics&) {
  BodyMotion body;
  const bool wants_joints = form != BodyForm::Links;
  if (wants_joints && !is_robot(motion.skeleton)) {
    return fail(make_error(ErrorKind::Usage, "BRG013",
                           "expected a robot's motion, whose root moves freely and whose joints "
                           "move in one way each; --form links takes any motion"));
  }
  const bool wants_links = form != BodyForm::Joints;
  if (wants_links) {
    body.components.push_back(links_of(motion));
  } else {
    body.components.push_back(columns_of(
        motion, 0, kRootColumns, component_like(ComponentKind::Poses, kLinkPosition, motion, 1)));
  }
  const std::size_t num_columns = motion.clip.num_coordinates;
  if (wants_joints && num_columns > kRootColumns) {
    Motion following = motion;
    fill_following_columns(following, 0);
    body.components.push_back(columns_of(following, kRootColumns, num_columns,
                                         component_like(ComponentKind::Values, kJointDisplacement,
                                                        motion, num_columns - kRootColumns)));
  }
  if (other == nullptr) return body;
  for (const Component& component : other->components) {
    if (component.content == kLinkPosition || component.content == kJointDisplacement) continue;
    body.components.push_back(component);
  }
  return body;
}

Result<BodyMotion> zmp(const BodyMotion& motion, bool is_root_relative, Diagnostics& diagnostics) {
  const Component* links = find_component(motion, ComponentKind::Poses, kLinkPosition);
  const Component* zmp = find_component(motion, ComponentKind::Vectors, kZmp);
  if (zmp != nullptr && zmp->is_root_relative == is_root_relative) return motion;
  if (zmp == nullptr || links == nullptr || links->num_frames == 0) {
    return fail(make_error(ErrorKind::Usage, "BRG010",
                           zmp == nullptr ? "expected a ZMP, found none"
                                          : "expected poses of the root link, found none"));
  }
  if (!have_same_times(zmp->timeline, links->timeline)) {
    return fail(make_error(ErrorKind::DataLoss, "BRG014",
                           "expected the ZMP at the times of the root link's poses, found others; "
                           "'kinefile resample --fps RATE' brings both to one rate"));
  }
  BodyMotion changed = motion;
  if (zmp->num_frames > links->num_frames) {
    diagnostics.add(Severity::Warning, "BRG014",
                    fmt::format("there are {} frames of ZMP and {} of links; the last root pose "
                                "counts for the others",
                                zmp->num_frames, links->num_frames));
  }
  Component& out = changed.components[static_cast<std::size_t>(zmp - motion.components.data())];
  out.is_root_relative = is_root_relative;
  for (std::size_t f = 0; f < out.num_frames; ++f) {
    const auto root = links->row(std::min(f, links->num_frames - 1)).first(links->width());
    const Quat rotation = rotation_of(*links, root);
    const Vec3 position(root[0], root[1], root[2]);
    const std::span<double> row = out.mutate()[f];
    const Vec3 point(row[0], row[1], row[2]);
    const Vec3 moved = is_root_relative ? rotation.conjugate() * (point - position)
                                        : Vec3(rotation * point + position);
    std::copy_n(moved.data(), 3, row.begin());
  }
  return changed;
}

}  // namespace kinefile::robot
