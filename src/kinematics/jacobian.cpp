// SPDX-License-Identifier: MIT
// One row at a time, joint by joint up to the root: what the kernel does for many, and its
// derivative. A column's derivative is how the point moves in the world while everything nearer to
// the root stands still.

#include <algorithm>
#include <cassert>
#include <cmath>

#include "kinematics/kinematics_plan.hpp"

namespace kinefile {
namespace {

Vec3 eigen_of(const simd::Vector& v) { return {v[0], v[1], v[2]}; }

Mat3 eigen_of(const simd::Matrix& m) {
  Mat3 matrix;
  matrix << eigen_of(m[0]), eigen_of(m[1]), eigen_of(m[2]);
  return matrix;
}

/// The quaternion of a free joint, not normalised.
Quat quaternion_in_row(const simd::PlannedJoint& joint, std::span<const double> row) {
  const double* q = &row[joint.quaternion_coordinate];
  return {q[0], q[1], q[2], q[3]};
}

/// Its rotation, normalised under the same condition as in the kernel.
Mat3 free_rotation_in_row(const simd::PlannedJoint& joint, std::span<const double> row) {
  constexpr double kRoundedSquare = 1e-8;
  const Quat q = quaternion_in_row(joint, row);
  const bool is_unit = std::abs(q.squaredNorm() - 1) <= kRoundedSquare;
  return (is_unit ? q : Quat(Quat::Coefficients(q.coeffs() / q.norm()))).toRotationMatrix();
}

/// Where a joint's origin lies in its parent's frame, without what the parent's tail does.
Vec3 origin_in_row(const simd::PlannedJoint& joint, std::span<const double> row) {
  Vec3 origin = eigen_of(joint.offset);
  for (const simd::Shift& shift : joint.shifts) {
    origin += row[shift.coordinate] * eigen_of(shift.direction);
  }
  return origin;
}

/// What a move of a tail adds to a point for a change of its coordinate by 1.
Vec3 step_of(const simd::TailMove& move, const Vec3& point) {
  const Vec3 direction = eigen_of(move.direction);
  return move.is_scale ? Vec3(point.dot(direction) * direction) : direction;
}

/// Applies the first `count` moves of a tail to a point; of them the last acts first.
Vec3 on_tail(const simd::PlannedJoint& joint, std::span<const double> row, std::size_t count,
             Vec3 point) {
  for (std::size_t m = count; m-- > 0;) {
    const simd::TailMove& move = joint.tail_moves[m];
    const double value = row[move.coordinate];
    point += (move.is_scale ? value - 1 : value) * step_of(move, point);
  }
  return point;
}

/// Applies the first `count` moves of a tail to a direction, which only scales change.
Vec3 along_tail(const simd::PlannedJoint& joint, std::span<const double> row, std::size_t count,
                Vec3 direction) {
  for (std::size_t m = count; m-- > 0;) {
    const simd::TailMove& move = joint.tail_moves[m];
    if (move.is_scale) direction += (row[move.coordinate] - 1) * step_of(move, direction);
  }
  return direction;
}

/// Adds derivatives to the columns of a Jacobian.
struct Columns {
  std::span<double> numbers;  ///< [coordinate][3]

  void add(std::size_t coordinate, const Vec3& derivative) const {
    for (std::size_t k = 0; k < 3; ++k) {
      numbers[3 * coordinate + k] += derivative[static_cast<Eigen::Index>(k)];
    }
  }
};

/// The moves of a joint's tail, for a point that they act on.
void add_tail(const simd::PlannedJoint& joint, const JointFrame& frame, const Vec3& point,
              std::span<const double> row, const Columns& columns) {
  Vec3 moved = point;  // by the moves further in
  for (std::size_t m = joint.tail_moves.size(); m-- > 0;) {
    const simd::TailMove& move = joint.tail_moves[m];
    const Vec3 step = step_of(move, moved);
    columns.add(move.coordinate, frame.rotation * along_tail(joint, row, m, step));
    const double value = row[move.coordinate];
    moved += (move.is_scale ? value - 1 : value) * step;
  }
}

/// The quaternion of a free joint. A change d of q turns the joint by the vector of
/// 2 d conjugate(q) / |q|^2, seen in the frame that the quaternion acts in.
void add_quaternion(const simd::PlannedJoint& joint, const Mat3& outer, const Vec3& arm,
                    std::span<const double> row, const Columns& columns) {
  const Quat q = quaternion_in_row(joint, row);
  const double factor = 2 / q.squaredNorm();
  const std::size_t first = joint.quaternion_coordinate;
  columns.add(first, (outer * (-factor * q.vec())).cross(arm));
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 unit = Vec3::Unit(static_cast<Eigen::Index>(k));
    const Vec3 turn = factor * (q.w() * unit + q.vec().cross(unit));
    columns.add(first + 1 + k, (outer * turn).cross(arm));
  }
}

/// The rotations of a joint.
/// \param outer  world_from_parent and the rest rotation
/// \param arm    from the joint's origin to the point, in the world
void add_rotations(const simd::PlannedJoint& joint, Mat3 outer, const Vec3& arm,
                   double radians_per_unit, std::span<const double> row, const Columns& columns) {
  if (joint.is_free) {
    add_quaternion(joint, outer, arm, row, columns);
    outer = outer * free_rotation_in_row(joint, row);
  }
  for (const simd::Turn& turn : joint.turns) {
    const Vec3 axis = eigen_of(turn.direction);
    columns.add(turn.coordinate, radians_per_unit * (outer * axis).cross(arm));
    outer = outer * Eigen::AngleAxisd(radians_per_unit * row[turn.coordinate], axis);
  }
}

}  // namespace

void Kinematics::place_row(std::span<const double> row, std::span<JointFrame> frames) const {
  const std::vector<simd::PlannedJoint>& joints = plan_->world.joints;
  assert(row.size() == plan_->num_coordinates && frames.size() == joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const simd::PlannedJoint& joint = joints[j];
    JointFrame& frame = frames[j];
    frame = joint.parent == simd::kNoJoint ? JointFrame{} : frames[joint.parent];
    Vec3 origin = origin_in_row(joint, row);
    if (joint.parent != simd::kNoJoint) {
      const simd::PlannedJoint& parent = joints[joint.parent];
      origin = on_tail(parent, row, parent.tail_moves.size(), origin);
    }
    frame.position += frame.rotation * origin;
    if (joint.has_rest_rotation) frame.rotation *= eigen_of(joint.rest_rotation);
    if (joint.is_free) frame.rotation *= free_rotation_in_row(joint, row);
    for (const simd::Turn& turn : joint.turns) {
      double angle = row[turn.coordinate];
      // Whole turns are taken off first, which is exact in degrees.
      if (plan_->world.is_in_degrees) angle = std::remainder(angle, 360.0) * kRadiansPerDegree;
      frame.rotation = frame.rotation * Eigen::AngleAxisd(angle, eigen_of(turn.direction));
    }
  }
}

Vec3 Kinematics::position_of(const JointPoint& point, std::span<const double> row,
                             std::span<const JointFrame> frames) const {
  const simd::PlannedJoint& joint = plan_->world.joints[point.joint];
  const JointFrame& frame = frames[point.joint];
  const std::size_t num_moves = point.is_on_tail ? joint.tail_moves.size() : 0;
  return frame.position + frame.rotation * on_tail(joint, row, num_moves, point.offset);
}

void Kinematics::jacobian(const JointPoint& point, std::span<const double> row,
                          std::span<const JointFrame> frames, std::span<double> jacobian) const {
  const std::vector<simd::PlannedJoint>& joints = plan_->world.joints;
  assert(jacobian.size() == 3 * plan_->num_coordinates && frames.size() == joints.size());
  std::fill(jacobian.begin(), jacobian.end(), 0.0);
  const Columns columns{jacobian};
  const Vec3 target = position_of(point, row, frames);
  if (point.is_on_tail) {
    add_tail(joints[point.joint], frames[point.joint], point.offset, row, columns);
  }
  for (std::size_t j = point.joint; j != simd::kNoJoint; j = joints[j].parent) {
    const simd::PlannedJoint& joint = joints[j];
    const bool is_root = joint.parent == simd::kNoJoint;
    const JointFrame parent_frame = is_root ? JointFrame{} : frames[joint.parent];
    const Mat3 outer = parent_frame.rotation * eigen_of(joint.rest_rotation);
    add_rotations(joint, outer, target - frames[j].position, plan_->radians_per_unit, row, columns);
    for (const simd::Shift& shift : joint.shifts) {
      Vec3 direction = eigen_of(shift.direction);
      if (!is_root) {
        const simd::PlannedJoint& parent = joints[joint.parent];
        direction = along_tail(parent, row, parent.tail_moves.size(), direction);
      }
      columns.add(shift.coordinate, parent_frame.rotation * direction);
    }
    if (is_root) break;
    add_tail(joints[joint.parent], parent_frame, origin_in_row(joint, row), row, columns);
  }
}

}  // namespace kinefile
