// SPDX-License-Identifier: MIT
#include "kinefile/joint_rotation.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace kinefile {
namespace {

/// The rotation vector of a rotation, in radians.
Vec3 rotation_vector(const Mat3& rotation) { return 2 * log_of(Quat(rotation)); }

/// Finds the angles that bring `rotations` nearest to a rotation, by Gauss and Newton, from the
/// angles that the row has.
void fit_least_squares(const std::vector<DegreeOfFreedom>& rotations, const Mat3& rotation,
                       AngleUnit unit, std::span<double> row) {
  constexpr int kMostSteps = 30;
  constexpr double kSmallStep = 1e-15;
  using Jacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 16>;
  const auto count = static_cast<Eigen::Index>(std::min<std::size_t>(rotations.size(), 16));
  for (int step = 0; step < kMostSteps; ++step) {
    // A small change of angle d turns the product by the axis, seen through the rotations outside.
    Mat3 outer = Mat3::Identity();
    Jacobian jacobian(3, count);
    for (Eigen::Index d = 0; d < count; ++d) {
      const DegreeOfFreedom& dof = rotations[static_cast<std::size_t>(d)];
      jacobian.col(d) = outer * dof.axis;
      outer = outer * Eigen::AngleAxisd(row[dof.coordinate] * radians_per(unit), dof.axis);
    }
    const Vec3 error = rotation_vector(rotation * outer.transpose());
    const Eigen::VectorXd change =
        (jacobian.transpose() * jacobian + 1e-12 * Eigen::MatrixXd::Identity(count, count))
            .ldlt()
            .solve(jacobian.transpose() * error);
    for (Eigen::Index d = 0; d < count; ++d) {
      row[rotations[static_cast<std::size_t>(d)].coordinate] += change[d] / radians_per(unit);
    }
    if (!(change.norm() > kSmallStep)) return;
  }
}

}  // namespace

std::vector<DegreeOfFreedom> rotations_of(const Joint& joint) {
  std::vector<DegreeOfFreedom> rotations;
  std::copy_if(joint.dofs.begin(), joint.dofs.end(), std::back_inserter(rotations),
               [](const DegreeOfFreedom& dof) { return dof.kind == DofKind::Rotation; });
  return rotations;
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

Mat3 rotation_in_row(const std::vector<DegreeOfFreedom>& rotations, std::span<const double> row,
                     AngleUnit unit) {
  Mat3 product = Mat3::Identity();
  for (const DegreeOfFreedom& dof : rotations) {
    double angle = row[dof.coordinate];
    // Whole turns are taken off first, which is exact in degrees.
    if (unit == AngleUnit::Degrees) angle = std::remainder(angle, 360.0) * kRadiansPerDegree;
    product = product * Eigen::AngleAxisd(angle, dof.axis);
  }
  return product;
}

double fit_rotation(const std::vector<DegreeOfFreedom>& rotations, const Mat3& rotation,
                    AngleUnit unit, std::span<double> row) {
  if (const auto axes = euler_axes_of(rotations)) {
    Vec3 near;
    for (std::size_t k = 0; k < 3; ++k) {
      near[static_cast<Eigen::Index>(k)] = row[rotations[k].coordinate] * radians_per(unit);
    }
    const Vec3 angles = euler_angles(rotation, *axes, near);
    for (std::size_t k = 0; k < 3; ++k) {
      row[rotations[k].coordinate] = angles[static_cast<Eigen::Index>(k)] / radians_per(unit);
    }
  } else if (!rotations.empty()) {
    fit_least_squares(rotations, rotation, unit, row);
  }
  return angle_between(Quat(rotation), Quat(rotation_in_row(rotations, row, unit)));
}

}  // namespace kinefile
