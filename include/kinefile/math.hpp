// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <numbers>
#include <optional>

namespace kinefile {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;  ///< constructed as (w, x, y, z)

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180;

/// 0, 1 or 2 for the unit vector along x, y or z; nothing for any other, their opposites too.
std::optional<std::size_t> coordinate_axis(const Vec3& axis);

/// Three axes in the order in which their rotations are multiplied, outermost first:
/// R = R(axes[0], a) R(axes[1], b) R(axes[2], c).
using EulerAxes = std::array<Vec3, 3>;

/// Finds the angles of a rotation about three axes.
/// \param rotation  a proper rotation matrix
/// \param axes      unit vectors; axes[1] at right angles to both others, axes[2] either along
///                  axes[0] (proper Euler) or along axes[0] x axes[1] (Tait-Bryan), up to sign;
///                  a precondition
/// \param near      of all triples that give `rotation`, the one nearest to this is returned, so
///                  that a curve stays continuous and turns beyond 180 degrees survive
/// \returns         three angles in radians
/// In gimbal lock, where one angle is free, the first keeps its value in `near`.
/// Only atan2 is used: asin and acos lose half of the digits near their ends.
Vec3 euler_angles(const Mat3& rotation, const EulerAxes& axes, const Vec3& near = Vec3::Zero());

/// The angle between two rotations, in radians, 0 to pi.
double angle_between(const Quat& a, const Quat& b);

}  // namespace kinefile
