// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <numbers>
#include <optional>

#pragma GCC visibility push(default)

namespace kinefile {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
/// Constructed as (w, x, y, z). Not aligned, so that the layout of structs does not depend on
/// compiler flags.
using Quat = Eigen::Quaternion<double, Eigen::DontAlign>;

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180;

/// Unit vectors that differ by less count as the same direction.
inline constexpr double kSameDirection = 1e-9;

/// 0, 1 or 2 for the unit vector along x, y or z; nothing for any other vector, also for -x, -y and
/// -z.
std::optional<std::size_t> coordinate_axis(const Vec3& axis);

/// Three axes in the order in which their rotations are multiplied, outermost first:
/// R = R(axes[0], a) R(axes[1], b) R(axes[2], c).
using EulerAxes = std::array<Vec3, 3>;

/// Finds the angles of a rotation about three axes.
/// \param rotation  a proper rotation matrix
/// \param axes      unit vectors; axes[1] perpendicular to both others, axes[2] either along
///                  axes[0] (proper Euler) or along axes[0] x axes[1] (Tait-Bryan), up to sign;
/// precondition
/// \param near      of all triples that give `rotation`, the one nearest to this is returned, so
///                  that a curve stays continuous and turns beyond 180 degrees survive
/// \returns         three angles in radians
/// In gimbal lock, where one angle is free, the first keeps its value in `near`.
/// Only atan2 is used: asin and acos lose half of the digits near -1 and 1.
Vec3 euler_angles(const Mat3& rotation, const EulerAxes& axes, const Vec3& near = Vec3::Zero());

/// The angle between two rotations, in radians, 0 to pi.
double angle_between(const Quat& a, const Quat& b);

/// The unit quaternion in the direction of `q`, also where its numbers are so large or so small
/// that a double does not hold the square of its length. Zero, which has no direction, gives the
/// identity; numbers that are not finite give NaN.
Quat unit_quaternion(const Quat& q);

/// The same rotation as `q`, with the sign that is nearer to `near`.
Quat on_side_of(const Quat& q, const Quat& near);

/// Interpolates along the great circle from `a` to the nearer of `b` and -b, at a constant rate.
/// Nearly equal ones are interpolated along the chord. If they are half a turn apart, no path is
/// the shortest, and the one towards -b is used.
/// \param t  0 gives a, 1 gives b or -b
/// Source: Shoemake, "Animating rotation with quaternion curves", SIGGRAPH 1985.
Quat slerp(const Quat& a, const Quat& b, double t);

/// Interpolates along the chord from `a` to the nearer of `b` and -b, and normalises.
Quat nlerp(const Quat& a, const Quat& b, double t);

/// The logarithm of a unit quaternion: half its rotation vector.
Vec3 log_of(const Quat& q);

/// The unit quaternion whose logarithm is `v`.
Quat exp_of(const Vec3& v);

/// The inner control point at `at` of a smooth curve through three rotations.
/// Source: Shoemake, "Quaternion calculus and fast animation", SIGGRAPH course notes, 1987.
Quat squad_control(const Quat& before, const Quat& at, const Quat& after);

/// Interpolates smoothly from `a` to `b`. All four quaternions must be on one side (see
/// `on_side_of`).
/// \param control_a, control_b  of `squad_control`
Quat squad(const Quat& a, const Quat& control_a, const Quat& control_b, const Quat& b, double t);

}  // namespace kinefile

#pragma GCC visibility pop
