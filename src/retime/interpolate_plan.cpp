// SPDX-License-Identifier: MIT
#include "retime/interpolate_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "kinefile/joint_rotation.hpp"
#include "kinematics/joint_columns.hpp"
#include "rotation/rotations.hpp"

namespace kinefile::retime {
namespace {

void note_single_angles(const Joint& joint, std::string_view reason, Diagnostics& diagnostics) {
  diagnostics.add(Severity::Note, "RTM007",
                  fmt::format("joint '{}' {}, so its rotation is interpolated number by number",
                              joint.name, reason));
}

void plan_turns(const Joint& joint, AngleUnit unit, const std::vector<std::size_t>& readers,
                InterpolationPlan& plan, Diagnostics& diagnostics) {
  const std::vector<DegreeOfFreedom> rotations = rotations_of(joint);
  // One angle is best interpolated as a number. So are two: the shortest path between their
  // rotations is not possible for the joint, and the nearest possible angles differ little from
  // linear ones (see the test that compares them).
  if (rotations.size() < 3 || is_whole_rotation(rotations)) return;
  const auto axes = euler_axes_of(rotations);
  if (!axes) {
    note_single_angles(joint, "turns about axes that not every rotation can be brought back to",
                       diagnostics);
    return;
  }
  const bool is_shared =
      std::any_of(rotations.begin(), rotations.end(),
                  [&readers](const DegreeOfFreedom& dof) { return readers[dof.coordinate] > 1; });
  if (is_shared) {
    note_single_angles(joint, "shares a column", diagnostics);
    return;
  }
  plan.turning_joints.push_back({{rotations[0], rotations[1], rotations[2]},
                                 rotation::euler_form(*axes, unit == AngleUnit::Degrees)});
}

void plan_whole_rotation(const Joint& joint, AngleUnit unit,
                         const std::vector<std::size_t>& readers, InterpolationPlan& plan,
                         Diagnostics& diagnostics) {
  const std::vector<DegreeOfFreedom> rotations = rotations_of(joint);
  if (!is_whole_rotation(rotations)) return;
  const DegreeOfFreedom& dof = rotations[0];
  const auto first = readers.begin() + static_cast<std::ptrdiff_t>(dof.coordinate);
  const auto end = first + static_cast<std::ptrdiff_t>(num_coordinates(dof));
  if (std::any_of(first, end, [](std::size_t count) { return count > 1; })) {
    note_single_angles(joint, "shares a column", diagnostics);
    return;
  }
  plan.whole_rotations.push_back({dof, unit});
}

/// All columns that do not belong to a rotation.
std::vector<std::size_t> other_columns(const InterpolationPlan& plan, std::size_t num_columns) {
  std::vector<bool> is_rotation(num_columns);
  for (const TurningJoint& joint : plan.turning_joints) {
    for (const DegreeOfFreedom& dof : joint.rotations) is_rotation[dof.coordinate] = true;
  }
  for (const WholeRotation& whole : plan.whole_rotations) {
    for (std::size_t k = 0; k < num_coordinates(whole.dof); ++k) {
      is_rotation[whole.dof.coordinate + k] = true;
    }
  }
  std::vector<std::size_t> others;
  for (std::size_t c = 0; c < num_columns; ++c) {
    if (!is_rotation[c]) others.push_back(c);
  }
  return others;
}

}  // namespace

InterpolationPlan plan_interpolation(const Skeleton& skeleton, RotationInterpolation rotation,
                                     Diagnostics& diagnostics) {
  const std::vector<std::size_t> readers = num_readers_of_columns(skeleton);
  InterpolationPlan plan;
  for (const Joint& joint : skeleton.joints) {
    plan_whole_rotation(joint, skeleton.angle_unit, readers, plan, diagnostics);
    if (rotation == RotationInterpolation::Euler) continue;
    plan_turns(joint, skeleton.angle_unit, readers, plan, diagnostics);
  }
  plan.number_columns = other_columns(plan, skeleton.coordinates.size());
  plan.turns = turns_of_columns(skeleton);
  return plan;
}

}  // namespace kinefile::retime
