// SPDX-License-Identifier: MIT
#include "edit/blend.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "kinefile/edit.hpp"
#include "kinefile/joint_rotation.hpp"
#include "kinefile/kinematics.hpp"
#include "kinematics/joint_columns.hpp"

namespace kinefile::edit {
namespace {

/// How a joint's frame is turned in its parent's frame.
Quat rotation_of(const Joint& joint, std::span<const double> row, AngleUnit unit) {
  if (const auto column = free_column(joint)) {
    return joint.rest_rotation * free_rotation(row, *column);
  }
  return joint.rest_rotation * Quat(rotation_in_row(rotations_of(joint), row, unit));
}

std::vector<std::size_t> roots_of(const Skeleton& skeleton) {
  std::vector<std::size_t> roots;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (skeleton.joints[j].parent == kNoParent) roots.push_back(j);
  }
  return roots;
}

bool can_turn(const Joint& joint) {
  return free_column(joint) || euler_axes_of(rotations_of(joint));
}

/// A movement on the ground: a turn about the axis that points up, then a shift.
struct GroundMove {
  Quat turn = Quat::Identity();
  Vec3 shift = Vec3::Zero();
};

/// The part of a rotation that is about an axis.
Quat twist_about(const Quat& rotation, Eigen::Index axis) {
  Quat twist = Quat::Identity();
  twist.w() = rotation.w();
  twist.vec()[axis] = rotation.vec()[axis];
  return twist.norm() > 0 ? twist.normalized() : Quat::Identity();
}

GroundMove move_between(const Joint& root, std::span<const double> from, std::span<const double> to,
                        Eigen::Index up, bool is_turned, AngleUnit unit) {
  GroundMove move;
  if (is_turned) {
    const Quat between = rotation_of(root, to, unit) * rotation_of(root, from, unit).conjugate();
    if (between.coeffs().allFinite()) move.turn = twist_about(between, up);
  }
  const auto translations = translation_columns(root);
  move.shift = position_in_row(root.offset, translations, to) -
               move.turn * position_in_row(root.offset, translations, from);
  move.shift[up] = 0;
  if (!move.shift.allFinite()) move.shift.setZero();
  return move;
}

/// Moves a root in all frames; angles go on from those of a frame before the first.
void move_root(const Joint& root, const GroundMove& move, std::span<const double> before,
               AngleUnit unit, Clip& clip) {
  const auto translations = translation_columns(root);
  const auto rotations = rotations_of(root);
  const auto free = free_column(root);
  const bool is_turned = move.turn.vec().norm() > 0;
  const Quat turn = root.rest_rotation.conjugate() * move.turn * root.rest_rotation;
  std::vector<double> near(before.begin(), before.end());
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    const auto row = clip.mutate()[f];
    const Vec3 place = position_in_row(root.offset, translations, row);
    if (!translations.empty())
      fit_position(root.offset, translations, move.turn * place + move.shift, row);
    if (!is_turned) continue;
    if (free) {
      set_free_rotation(row, *free, turn * free_rotation(row, *free));
      continue;
    }
    const Mat3 turned = turn.toRotationMatrix() * rotation_in_row(rotations, row, unit);
    if (!turned.allFinite()) continue;
    fit_rotation(rotations, turned, unit, near);
    for (const DegreeOfFreedom& dof : rotations) row[dof.coordinate] = near[dof.coordinate];
  }
}

}  // namespace

Motion moved_to(const Motion& motion, std::size_t frame, const Motion& other,
                std::size_t other_frame) {
  Motion result = motion;
  const Skeleton& skeleton = motion.skeleton;
  const auto roots = roots_of(skeleton);
  const auto lead = std::find_if(roots.begin(), roots.end(), [&skeleton](std::size_t root) {
    return !translation_columns(skeleton.joints[root]).empty();
  });
  if (lead == roots.end()) return result;
  const bool is_turned = std::all_of(roots.begin(), roots.end(), [&skeleton](std::size_t root) {
    return can_turn(skeleton.joints[root]);
  });
  const auto up = static_cast<Eigen::Index>(guess_up_axis(other));
  const GroundMove move =
      move_between(skeleton.joints[*lead], motion.clip.row(frame), other.clip.row(other_frame), up,
                   is_turned, skeleton.angle_unit);
  for (const std::size_t root : roots) {
    move_root(skeleton.joints[root], move, other.clip.row(other_frame), skeleton.angle_unit,
              result.clip);
  }
  return result;
}

Blender::Blender(const Skeleton& skeleton)
    : unit_(skeleton.angle_unit), is_angle_(skeleton.coordinates.size(), false) {
  for (const Joint& joint : skeleton.joints) {
    auto rotations = rotations_of(joint);
    for (const DegreeOfFreedom& dof : rotations) is_angle_[dof.coordinate] = true;
    if (const auto column = free_column(joint)) {
      turns_.push_back({{}, *column});
    } else if (euler_axes_of(rotations)) {
      turns_.push_back({std::move(rotations), 0});
    }
  }
}

void Blender::blend(std::span<const double> to, double weight, std::span<double> row) const {
  const std::vector<double> from(row.begin(), row.end());
  const double turn = whole_turn(unit_);
  for (std::size_t c = 0; c < row.size(); ++c) {
    const double shift = is_angle_[c] ? turn * std::round((to[c] - from[c]) / turn) : 0;
    row[c] = from[c] == to[c] ? to[c] : (1 - weight) * (from[c] + shift) + weight * to[c];
  }
  for (const Turn& joint : turns_) {
    if (joint.rotations.empty()) {
      const Quat blended = slerp(free_rotation(from, joint.free_column),
                                 free_rotation(to, joint.free_column), weight);
      set_free_rotation(row, joint.free_column, blended);
      continue;
    }
    const auto is_equal = [&from, &to](const DegreeOfFreedom& dof) {
      return from[dof.coordinate] == to[dof.coordinate];
    };
    if (std::all_of(joint.rotations.begin(), joint.rotations.end(), is_equal)) continue;
    const Quat blended = slerp(Quat(rotation_in_row(joint.rotations, from, unit_)),
                               Quat(rotation_in_row(joint.rotations, to, unit_)), weight);
    for (const DegreeOfFreedom& dof : joint.rotations) row[dof.coordinate] = to[dof.coordinate];
    fit_rotation(joint.rotations, blended.toRotationMatrix(), unit_, row);
  }
}

}  // namespace kinefile::edit
