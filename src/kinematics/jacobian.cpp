// SPDX-License-Identifier: MIT
// Computes one row at a time, from a joint up to the root: the same as the kernel for many rows,
// and its derivative. The derivative by a column is the velocity of the point in the world while
// all joints nearer to the root are fixed.

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

/// The quaternion of a joint, not normalised.
Quat quaternion_in_row(const simd::PlannedJoint& joint, std::span<const double> row) {
  const double* q = &row[joint.whole_coordinate];
  return {q[0], q[1], q[2], q[3]};
}

/// Its rotation, normalised under the same condition as in the kernel.
Mat3 rotation_of_quaternion(const simd::PlannedJoint& joint, std::span<const double> row) {
  constexpr double kRoundedSquare = 1e-8;
  const Quat q = quaternion_in_row(joint, row);
  const bool is_unit = std::abs(q.squaredNorm() - 1) <= kRoundedSquare;
  return (is_unit ? q : unit_quaternion(q)).toRotationMatrix();
}

/// The rotation vector of a joint, in radians.
Vec3 vector_in_row(const simd::PlannedJoint& joint, double radians_per_unit,
                   std::span<const double> row) {
  return radians_per_unit * Vec3(&row[joint.whole_coordinate]);
}

Mat3 rotation_of_vector(const Vec3& vector) {
  const double angle = vector.norm();
  return Eigen::AngleAxisd(angle, angle == 0 ? Vec3::UnitX() : Vec3(vector / angle)).matrix();
}

/// The whole rotation of a joint, if it has one.
Mat3 whole_rotation(const simd::PlannedJoint& joint, double radians_per_unit,
                    std::span<const double> row) {
  if (joint.whole == simd::WholeRotation::Quaternion) return rotation_of_quaternion(joint, row);
  return rotation_of_vector(vector_in_row(joint, radians_per_unit, row));
}

/// The rotation caused by a change of a rotation vector, in the frame in which the rotation acts:
/// the left Jacobian of the exponential map.
Mat3 turn_of_vector(const Vec3& vector) {
  constexpr double kSmall = 1e-4;  // radians; below, two terms of the series are exact
  const double square = vector.squaredNorm();
  const double angle = std::sqrt(square);
  const bool is_small = angle < kSmall;
  const double first = is_small ? 0.5 - square / 24 : (1 - std::cos(angle)) / square;
  const double second =
      is_small ? 1.0 / 6 - square / 120 : (angle - std::sin(angle)) / (square * angle);
  Mat3 cross;
  cross << 0, -vector[2], vector[1], vector[2], 0, -vector[0], -vector[1], vector[0], 0;
  return Mat3::Identity() + first * cross + second * (cross * cross);
}

/// The position of a joint's origin in its parent's frame, without the parent's tail moves.
Vec3 origin_in_row(const simd::PlannedJoint& joint, std::span<const double> row) {
  Vec3 origin = eigen_of(joint.offset);
  for (const simd::Shift& shift : joint.shifts) {
    origin += shift.input.value(row.data()) * eigen_of(shift.direction);
  }
  return origin;
}

/// The derivative of a point by the value of a tail move.
Vec3 step_of(const simd::TailMove& move, const Vec3& point) {
  const Vec3 direction = eigen_of(move.direction);
  return move.is_scale ? Vec3(point.dot(direction) * direction) : direction;
}

/// Applies the first `count` moves of a tail to a point; of them the last acts first.
Vec3 on_tail(const simd::PlannedJoint& joint, std::span<const double> row, std::size_t count,
             Vec3 point) {
  for (std::size_t m = count; m-- > 0;) {
    const simd::TailMove& move = joint.tail_moves[m];
    const double value = move.input.value(row.data());
    point += (move.is_scale ? value - 1 : value) * step_of(move, point);
  }
  return point;
}

/// Applies the first `count` moves of a tail to a direction, which only scales change.
Vec3 along_tail(const simd::PlannedJoint& joint, std::span<const double> row, std::size_t count,
                Vec3 direction) {
  for (std::size_t m = count; m-- > 0;) {
    const simd::TailMove& move = joint.tail_moves[m];
    if (!move.is_scale) continue;
    direction += (move.input.value(row.data()) - 1) * step_of(move, direction);
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
  /// \param derivative  the derivative by the value of the degree of freedom
  void add(const simd::Input& input, const Vec3& derivative) const {
    add(input.coordinate, input.gain * derivative);
  }
};

/// The moves of a joint's tail, for a point that they act on.
void add_tail(const simd::PlannedJoint& joint, const JointFrame& frame, const Vec3& point,
              std::span<const double> row, const Columns& columns) {
  Vec3 moved = point;  // the point after the inner moves
  for (std::size_t m = joint.tail_moves.size(); m-- > 0;) {
    const simd::TailMove& move = joint.tail_moves[m];
    const Vec3 step = step_of(move, moved);
    columns.add(move.input, frame.rotation * along_tail(joint, row, m, step));
    const double value = move.input.value(row.data());
    moved += (move.is_scale ? value - 1 : value) * step;
  }
}

/// A quaternion. A change d of q rotates the joint by the vector part of 2 d conjugate(q) / |q|^2,
/// in the frame in which the quaternion acts.
void add_quaternion(const simd::PlannedJoint& joint, const Mat3& outer, const Vec3& arm,
                    std::span<const double> row, const Columns& columns) {
  const Quat q = quaternion_in_row(joint, row);
  const double factor = 2 / q.squaredNorm();
  const std::size_t first = joint.whole_coordinate;
  columns.add(first, (outer * (-factor * q.vec())).cross(arm));
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 unit = Vec3::Unit(static_cast<Eigen::Index>(k));
    const Vec3 turn = factor * (q.w() * unit + q.vec().cross(unit));
    columns.add(first + 1 + k, (outer * turn).cross(arm));
  }
}

void add_vector(const simd::PlannedJoint& joint, const Mat3& outer, const Vec3& arm,
                double radians_per_unit, std::span<const double> row, const Columns& columns) {
  const Mat3 turn = outer * turn_of_vector(vector_in_row(joint, radians_per_unit, row));
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 axis = turn.col(static_cast<Eigen::Index>(k));
    columns.add(joint.whole_coordinate + k, radians_per_unit * axis.cross(arm));
  }
}

/// The rotations of a joint.
/// \param outer  world_from_parent and the rest rotation
/// \param arm    from the joint's origin to the point, in the world
void add_rotations(const simd::PlannedJoint& joint, Mat3 outer, const Vec3& arm,
                   double radians_per_unit, std::span<const double> row, const Columns& columns) {
  if (joint.whole == simd::WholeRotation::Quaternion) {
    add_quaternion(joint, outer, arm, row, columns);
  } else if (joint.whole == simd::WholeRotation::AxisAngle) {
    add_vector(joint, outer, arm, radians_per_unit, row, columns);
  }
  for (const simd::Turn& turn : joint.turns) {  // empty if there is a whole rotation
    const Vec3 axis = eigen_of(turn.direction);
    columns.add(turn.input, radians_per_unit * (outer * axis).cross(arm));
    outer = outer * Eigen::AngleAxisd(radians_per_unit * turn.input.value(row.data()), axis);
  }
}

}  // namespace

void Kinematics::place_row(std::span<const double> row, std::span<JointFrame> frames) const {
  const std::vector<simd::PlannedJoint>& joints = plan_->joints.joints;
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
    if (joint.whole != simd::WholeRotation::None) {
      frame.rotation *= whole_rotation(joint, plan_->radians_per_unit, row);
    }
    for (const simd::Turn& turn : joint.turns) {
      double angle = turn.input.value(row.data());
      // Whole turns are subtracted first, which is exact in degrees.
      if (plan_->joints.is_in_degrees) angle = std::remainder(angle, 360.0) * kRadiansPerDegree;
      frame.rotation = frame.rotation * Eigen::AngleAxisd(angle, eigen_of(turn.direction));
    }
  }
}

Vec3 Kinematics::position_of(const JointPoint& point, std::span<const double> row,
                             std::span<const JointFrame> frames) const {
  const simd::PlannedJoint& joint = plan_->joints.joints[point.joint];
  const JointFrame& frame = frames[point.joint];
  const std::size_t num_moves = point.is_on_tail ? joint.tail_moves.size() : 0;
  return frame.position + frame.rotation * on_tail(joint, row, num_moves, point.offset);
}

void Kinematics::jacobian(const JointPoint& point, std::span<const double> row,
                          std::span<const JointFrame> frames, std::span<double> jacobian) const {
  const std::vector<simd::PlannedJoint>& joints = plan_->joints.joints;
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
      columns.add(shift.input, parent_frame.rotation * direction);
    }
    if (is_root) break;
    add_tail(joints[joint.parent], parent_frame, origin_in_row(joint, row), row, columns);
  }
}

}  // namespace kinefile
