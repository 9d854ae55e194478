// SPDX-License-Identifier: MIT
#include "kinefile/joint_rotation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kinematics/joint_columns.hpp"
#include "math/turns.hpp"

namespace kinefile {
namespace {

/// The rotation vector of a rotation, in radians.
Vec3 rotation_vector(const Mat3& rotation) { return 2 * log_of(Quat(rotation)); }

/// An angle in radians. Whole turns are subtracted first, which is exact in degrees.
double radians_of(double angle, AngleUnit unit) {
  return unit == AngleUnit::Degrees ? std::remainder(angle, 360.0) * kRadiansPerDegree : angle;
}

Quat quaternion_of_vector(const Vec3& vector, AngleUnit unit) {
  const double length = vector.norm();
  const double half = 0.5 * radians_of(length, unit);
  const Vec3 axis = length == 0 ? Vec3(Vec3::Zero()) : Vec3(vector / length);
  const Vec3 v = std::sin(half) * axis;
  return Quat(std::cos(half), v.x(), v.y(), v.z());
}

/// The rotation vector of a rotation that is nearest to another one: chosen from all angles about
/// its axis that give the rotation.
Vec3 rotation_vector_near(const Quat& rotation, AngleUnit unit, const Vec3& near) {
  const double turn = 2 * std::numbers::pi / radians_per(unit);
  const Vec3 shortest = 2 * log_of(rotation) / radians_per(unit);
  const double angle = shortest.norm();
  if (!near.allFinite()) return shortest;
  if (angle == 0) {  // every axis gives the identity: keep the current one
    const double length = near.norm();
    const double whole = turn * std::round(length / turn);
    return whole == 0 ? Vec3(Vec3::Zero()) : Vec3(near * (whole / length));
  }
  const Vec3 axis = shortest / angle;
  return nearest_turn(angle, near.dot(axis), turn) * axis;
}

/// Whether one degree of freedom alone reads its column among some.
bool has_own_column(const std::vector<DegreeOfFreedom>& rotations, const DegreeOfFreedom& dof) {
  return std::count_if(rotations.begin(), rotations.end(), [&dof](const DegreeOfFreedom& other) {
           return other.coordinate == dof.coordinate;
         }) == 1;
}

/// Takes whole turns away by which angles went further than they need from where they were.
/// \param start  the values of `rotations` before
void take_short_way(const std::vector<DegreeOfFreedom>& rotations, const std::vector<double>& start,
                    AngleUnit unit, std::span<double> row) {
  for (std::size_t d = 0; d < rotations.size(); ++d) {
    const DegreeOfFreedom& dof = rotations[d];
    if (dof.gain == 0 || !has_own_column(rotations, dof)) continue;
    const double value = value_of(dof, row[dof.coordinate]);
    const double turns = turns_towards(value, start[d], whole_turn(unit));
    if (turns != 0) row[dof.coordinate] = column_of(dof, value + turns);
  }
}

/// Finds the angles for which `rotations` are nearest to a rotation, by the Gauss-Newton method,
/// starting from the angles in the row. Near a singular pose a step would be far too long.
void fit_least_squares(const std::vector<DegreeOfFreedom>& rotations, const Mat3& rotation,
                       AngleUnit unit, const std::vector<bool>& follows, std::span<double> row) {
  constexpr int kMostSteps = 100;
  constexpr double kLongestStep = 0.3;  // radians
  constexpr double kSmallStep = 1e-15;
  using Jacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 16>;
  const auto count = static_cast<Eigen::Index>(std::min<std::size_t>(rotations.size(), 16));
  std::vector<double> start;
  for (const DegreeOfFreedom& dof : rotations) start.push_back(value_of(dof, row[dof.coordinate]));
  for (int step = 0; step < kMostSteps; ++step) {
    // A small change of angle d rotates the product about the axis, transformed by the outer
    // rotations.
    Mat3 outer = Mat3::Identity();
    Jacobian jacobian(3, count);
    for (Eigen::Index d = 0; d < count; ++d) {
      const auto index = static_cast<std::size_t>(d);
      const DegreeOfFreedom& dof = rotations[index];
      const bool is_fixed = !follows.empty() && follows[index];
      jacobian.col(d) = is_fixed ? Vec3(Vec3::Zero()) : Vec3(outer * dof.axis);
      const double angle = value_of(dof, row[dof.coordinate]) * radians_per(unit);
      outer = outer * Eigen::AngleAxisd(angle, dof.axis);
    }
    const Vec3 error = rotation_vector(rotation * outer.transpose());
    Eigen::VectorXd change =
        (jacobian.transpose() * jacobian + 1e-12 * Eigen::MatrixXd::Identity(count, count))
            .ldlt()
            .solve(jacobian.transpose() * error);
    if (change.norm() > kLongestStep) change *= kLongestStep / change.norm();
    for (Eigen::Index d = 0; d < count; ++d) {
      const DegreeOfFreedom& dof = rotations[static_cast<std::size_t>(d)];
      const double per_number = dof.gain * radians_per(unit);
      if (per_number != 0 && change[d] != 0) row[dof.coordinate] += change[d] / per_number;
    }
    if (!(change.norm() > kSmallStep)) break;
  }
  take_short_way(rotations, start, unit, row);
}

void fit_euler(const std::vector<DegreeOfFreedom>& rotations, const EulerAxes& axes,
               const Mat3& rotation, AngleUnit unit, std::span<double> row) {
  Vec3 near;
  for (std::size_t k = 0; k < 3; ++k) {
    const double value = value_of(rotations[k], row[rotations[k].coordinate]);
    near[static_cast<Eigen::Index>(k)] = value * radians_per(unit);
  }
  const Vec3 angles = euler_angles(rotation, axes, near);
  for (std::size_t k = 0; k < 3; ++k) {
    const double value = angles[static_cast<Eigen::Index>(k)] / radians_per(unit);
    row[rotations[k].coordinate] = column_of(rotations[k], value);
  }
}

}  // namespace

std::vector<DegreeOfFreedom> rotations_of(const Joint& joint) {
  std::vector<DegreeOfFreedom> rotations;
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind == DofKind::Free) {
      rotations.push_back({DofKind::Ball, Vec3::UnitX(), dof.coordinate + 3, 0});
    } else if (dof.kind == DofKind::Rotation || dof.kind == DofKind::Ball ||
               dof.kind == DofKind::RotationVector) {
      rotations.push_back(dof);
    }
  }
  return rotations;
}

bool is_whole_rotation(const std::vector<DegreeOfFreedom>& rotations) {
  return rotations.size() == 1 && rotations[0].kind != DofKind::Rotation;
}

std::optional<EulerAxes> euler_axes_of(const std::vector<DegreeOfFreedom>& rotations) {
  constexpr double kTolerance = 1e-9;
  if (rotations.size() != 3) return std::nullopt;
  const EulerAxes axes = {rotations[0].axis, rotations[1].axis, rotations[2].axis};
  const double along_first = std::abs(axes[2].dot(axes[0]));
  const double along_third = std::abs(axes[2].dot(axes[0].cross(axes[1])));
  const bool is_square =
      std::abs(axes[0].dot(axes[1])) < kTolerance && std::abs(axes[1].dot(axes[2])) < kTolerance;
  const bool is_euler = is_square && (std::abs(along_first - 1) < kTolerance ||
                                      std::abs(along_third - 1) < kTolerance);
  return is_euler ? std::optional(axes) : std::nullopt;
}

bool can_turn_in_any_way(const std::vector<DegreeOfFreedom>& rotations) {
  return is_whole_rotation(rotations) || euler_axes_of(rotations);
}

Mat3 rotation_in_row(const std::vector<DegreeOfFreedom>& rotations, std::span<const double> row,
                     AngleUnit unit) {
  if (is_whole_rotation(rotations)) {
    return quaternion_in_row(rotations, row, unit).toRotationMatrix();
  }
  Mat3 product = Mat3::Identity();
  for (const DegreeOfFreedom& dof : rotations) {
    const double angle = radians_of(value_of(dof, row[dof.coordinate]), unit);
    product = product * Eigen::AngleAxisd(angle, dof.axis);
  }
  return product;
}

Quat quaternion_in_row(const std::vector<DegreeOfFreedom>& rotations, std::span<const double> row,
                       AngleUnit unit) {
  if (is_whole_rotation(rotations)) return whole_rotation_in_row(rotations[0], row, unit);
  return Quat(rotation_in_row(rotations, row, unit));
}

Quat whole_rotation_in_row(const DegreeOfFreedom& dof, std::span<const double> row,
                           AngleUnit unit) {
  const double* first = &row[dof.coordinate];
  if (dof.kind == DofKind::RotationVector) return quaternion_of_vector(Vec3(first), unit);
  return unit_quaternion({first[0], first[1], first[2], first[3]});
}

Quat rotation_at_rest(const Joint& joint, AngleUnit unit) {
  if (moves_freely(joint)) {
    const auto& rest = joint.free_rest;
    return unit_quaternion({rest[3], rest[4], rest[5], rest[6]});
  }
  Quat product = Quat::Identity();
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind != DofKind::Rotation) continue;
    const double angle = value_of(dof, dof.rest) * radians_per(unit);
    if (angle != 0) product = product * Quat(Eigen::AngleAxisd(angle, dof.axis));
  }
  return product;
}

void set_whole_rotation(const DegreeOfFreedom& dof, const Quat& rotation, AngleUnit unit,
                        std::span<double> row) {
  double* out = &row[dof.coordinate];
  if (dof.kind == DofKind::RotationVector) {
    const Vec3 before(out);
    const Vec3 vector = rotation_vector_near(rotation, unit, before);
    std::copy_n(vector.data(), 3, out);
    return;
  }
  const Eigen::Vector4d before(out[0], out[1], out[2], out[3]);
  const Eigen::Vector4d now(rotation.w(), rotation.x(), rotation.y(), rotation.z());
  const bool is_opposite = before.allFinite() && before.dot(now) < 0;
  for (Eigen::Index k = 0; k < 4; ++k) out[k] = is_opposite ? -now[k] : now[k];
}

double fit_rotation(const std::vector<DegreeOfFreedom>& rotations, const Mat3& rotation,
                    AngleUnit unit, std::span<double> row, const std::vector<bool>& follows) {
  const bool any_follows = std::find(follows.begin(), follows.end(), true) != follows.end();
  const auto axes = euler_axes_of(rotations);
  const bool is_free_to_turn = std::none_of(
      rotations.begin(), rotations.end(), [](const DegreeOfFreedom& dof) { return dof.gain == 0; });
  if (is_whole_rotation(rotations)) {
    if (!any_follows) set_whole_rotation(rotations[0], Quat(rotation), unit, row);
  } else if (axes && !any_follows && is_free_to_turn) {
    fit_euler(rotations, *axes, rotation, unit, row);
  } else if (!rotations.empty()) {
    fit_least_squares(rotations, rotation, unit, follows, row);
  }
  return angle_between(Quat(rotation), quaternion_in_row(rotations, row, unit));
}

}  // namespace kinefile
