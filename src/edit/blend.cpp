// SPDX-License-Identifier: MIT
#include "edit/blend.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "edit/travel.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/joint_rotation.hpp"
#include "kinematics/joint_columns.hpp"
#include "kinematics/rotation_batches.hpp"
#include "math/turns.hpp"
#include "simd/slerp.hpp"

namespace kinefile::edit {
namespace {

/// The rotation of a traveller in the world.
Quat rotation_of(const Traveller& traveller, const Joint& joint, std::span<const double> row,
                 AngleUnit unit) {
  const Quat in_parent = joint.rest_rotation * quaternion_in_row(rotations_of(joint), row, unit);
  return traveller.is_root ? in_parent : Quat(traveller.world_from_parent * in_parent);
}

/// Whether a joint is a point: a turn about another place moves it, and that is all.
bool is_point(const Skeleton& skeleton, std::size_t root) {
  const Joint& joint = skeleton.joints[root];
  return rotations_of(joint).empty() && joint.tips.empty() &&
         std::none_of(skeleton.joints.begin(), skeleton.joints.end(),
                      [root](const Joint& other) { return other.parent == root; });
}

bool can_turn(const Skeleton& skeleton, std::size_t root) {
  return can_turn_in_any_way(rotations_of(skeleton.joints[root])) || is_point(skeleton, root);
}

/// A rigid motion on the ground: a rotation about the axis that points up, then a translation.
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

/// The motion on the ground that takes a position and, if given, a rotation to others.
GroundMove move_between(const Vec3& from, const Vec3& to, const std::optional<Quat>& turn,
                        Eigen::Index up) {
  GroundMove move;
  if (turn && turn->coeffs().allFinite()) move.turn = twist_about(*turn, up);
  move.shift = to - move.turn * from;
  move.shift[up] = 0;
  if (!move.shift.allFinite()) move.shift.setZero();
  return move;
}

/// Rotates a joint in its parent's frame in all frames; angles continue from those of a frame
/// before the first.
void turn_joint(const Joint& joint, const Quat& turn, std::span<const double> before,
                AngleUnit unit, Clip& clip) {
  const Rows rows = clip.mutate();
  const auto rotations = rotations_of(joint);
  const RotationReader reader(rotations, unit);
  RotationFitter fitter(rotations, unit, before);
  simd::Quaternions turned;
  for (const FrameBatch& frames : batches_of(clip.num_frames)) {
    reader.read(clip, frames, turned);
    for (std::size_t i = 0; i < frames.count; ++i) {
      rotation::put_quaternion(turn * rotation::quaternion_at(turned, i), i, turned);
    }
    fitter.fit(turned, frames, rows);
  }
}

/// Applies a rigid motion to a traveller in all frames; angles continue from those of a frame
/// before the first.
void move_traveller(const Traveller& traveller, const Joint& joint, const GroundMove& move,
                    std::span<const double> before, AngleUnit unit, Clip& clip) {
  const Rows rows = clip.mutate();
  for (std::size_t f = 0; !traveller.translations.empty() && f < clip.num_frames; ++f) {
    move_to(traveller, move.turn * position_of(traveller, rows[f]) + move.shift, rows[f]);
  }
  if (move.turn.vec().norm() == 0 || rotations_of(joint).empty()) return;
  Quat in_parent = move.turn;
  in_parent.vec() = to_parent(traveller, move.turn.vec());
  turn_joint(joint, joint.rest_rotation.conjugate() * in_parent * joint.rest_rotation, before, unit,
             clip);
}

/// What is blended: rows of two clips, of which one is changed.
struct Fade {
  const Clip& from;
  const Clip& to;
  std::span<const double> weights;
  AngleUnit unit;

  bool is_equal(std::size_t i, std::size_t column) const {
    return from.row(i)[column] == to.row(i)[column];
  }
};

/// \param turns  of `turns_of_columns`
void fade_numbers(const Fade& fade, const std::vector<double>& turns, const Rows& rows,
                  std::size_t first) {
  for (std::size_t i = 0; i < fade.weights.size(); ++i) {
    const auto from = fade.from.row(i);
    const auto to = fade.to.row(i);
    const auto row = rows[first + i];
    const double weight = fade.weights[i];
    for (std::size_t c = 0; c < row.size(); ++c) {
      const double turn = turns[c];
      const double shift = turn > 0 ? turns_towards(from[c], to[c], turn) : 0;
      row[c] = from[c] == to[c] ? to[c] : (1 - weight) * (from[c] + shift) + weight * to[c];
    }
  }
}

void fade_whole(const Fade& fade, const DegreeOfFreedom& dof, const Rows& rows, std::size_t first) {
  for (std::size_t i = 0; i < fade.weights.size(); ++i) {
    bool is_equal = true;
    for (std::size_t k = 0; k < num_coordinates(dof); ++k) {
      is_equal = is_equal && fade.is_equal(i, dof.coordinate + k);
    }
    if (is_equal) continue;
    const auto to = fade.to.row(i);
    const Quat blended = slerp(whole_rotation_in_row(dof, fade.from.row(i), fade.unit),
                               whole_rotation_in_row(dof, to, fade.unit), fade.weights[i]);
    const auto row = rows[first + i];
    std::copy_n(&to[dof.coordinate], num_coordinates(dof), &row[dof.coordinate]);
    set_whole_rotation(dof, blended, fade.unit, row);
  }
}

/// Blends three rotations of a joint. The kernel's quaternions are the joint's own up to constant
/// factors, which do not affect the interpolation.
void fade_turns(const Fade& fade, const std::vector<DegreeOfFreedom>& rotations,
                const EulerAxes& axes, const Rows& rows, std::size_t first) {
  const std::size_t count = fade.weights.size();
  const auto form = rotation::euler_form(axes, fade.unit == AngleUnit::Degrees);
  simd::Angles ends;  // the first half those of `from`, the second half those of `to`
  simd::Angles angles;
  rotation::resize(ends, 2 * count);
  rotation::resize(angles, count);
  std::vector<simd::Between> places(simd::padded(count), {0, 0, 0});
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      ends[k][i] = value_in_row(rotations[k], fade.from.row(i));
      ends[k][count + i] = angles[k][i] = value_in_row(rotations[k], fade.to.row(i));
    }
    places[i] = {i, count + i, fade.weights[i]};
  }
  simd::Quaternions rotations_at_ends;
  simd::Quaternions blended;
  simd::quaternions_of_angles(form, ends, rotations_at_ends);
  simd::slerp(rotations_at_ends, places, blended);
  simd::angles_of_quaternions(form, blended, angles);
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_equal =
        std::all_of(rotations.begin(), rotations.end(),
                    [&](const DegreeOfFreedom& dof) { return fade.is_equal(i, dof.coordinate); });
    for (std::size_t k = 0; !is_equal && k < 3; ++k) {
      rows[first + i][rotations[k].coordinate] = column_of(rotations[k], angles[k][i]);
    }
  }
}

}  // namespace

Motion moved_to(Motion motion, std::size_t frame, const Motion& other, std::size_t other_frame,
                const Ground& ground) {
  const std::vector<Joint>& joints = motion.skeleton.joints;
  const AngleUnit unit = motion.skeleton.angle_unit;
  const auto travellers = travellers_of(motion, ground.travellers);
  const auto lead = std::find_if(travellers.begin(), travellers.end(),
                                 [](const Traveller& t) { return !t.translations.empty(); });
  if (lead == travellers.end()) return motion;
  const Traveller there = travellers_of(other, std::array{lead->joint}).front();
  const auto before = other.clip.row(other_frame);
  const auto row = motion.clip.row(frame);
  const bool is_turned = std::all_of(travellers.begin(), travellers.end(), [&](const Traveller& t) {
    return can_turn(motion.skeleton, t.joint);
  });
  std::optional<Quat> turn;
  if (is_turned) {
    const Joint& joint = joints[lead->joint];
    turn =
        rotation_of(there, joint, before, unit) * rotation_of(*lead, joint, row, unit).conjugate();
  }
  const GroundMove move = move_between(position_of(*lead, row), position_of(there, before), turn,
                                       static_cast<Eigen::Index>(ground.up));
  for (const Traveller& traveller : travellers) {
    move_traveller(traveller, joints[traveller.joint], move, before, unit, motion.clip);
  }
  return motion;
}

void fade(const Skeleton& skeleton, const Clip& to, std::span<const double> weights,
          std::size_t first, Clip& clip) {
  const std::size_t width = clip.num_coordinates;
  Clip from;  // a copy, because the changed rows are read until the end
  from.num_frames = weights.size();
  from.num_coordinates = width;
  from.values = Array<double>(
      std::span<const double>(clip.values).subspan(first * width, weights.size() * width));
  const Rows rows = clip.mutate();
  const Fade fade{from, to, weights, skeleton.angle_unit};
  fade_numbers(fade, turns_of_columns(skeleton), rows, first);
  const std::vector<std::size_t> leaders = leaders_of_columns(skeleton);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const auto rotations = rotations_of(skeleton.joints[j]);
    const auto follows = following_dofs(rotations, j, leaders);
    if (std::find(follows.begin(), follows.end(), true) != follows.end()) continue;
    if (is_whole_rotation(rotations)) {
      fade_whole(fade, rotations[0], rows, first);
    } else if (const auto axes = euler_axes_of(rotations)) {
      fade_turns(fade, rotations, *axes, rows, first);
    }
  }
}

}  // namespace kinefile::edit
