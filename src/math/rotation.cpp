// SPDX-License-Identifier: MIT
#include <cassert>
#include <cmath>

#include "kinefile/math.hpp"
#include "math/turns.hpp"

namespace kinefile {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

[[maybe_unused]] bool are_euler_axes(const EulerAxes& axes) {
  constexpr double kTolerance = 1e-9;
  for (const Vec3& axis : axes) {
    if (std::abs(axis.norm() - 1) > kTolerance) return false;
  }
  const double along_first = std::abs(axes[2].dot(axes[0]));
  const double along_third = std::abs(axes[2].dot(axes[0].cross(axes[1])));
  return std::abs(axes[0].dot(axes[1])) < kTolerance &&
         (std::abs(along_first - 1) < kTolerance || std::abs(along_third - 1) < kTolerance);
}

}  // namespace

std::optional<std::size_t> coordinate_axis(const Vec3& axis) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (axis == Vec3::Unit(static_cast<Eigen::Index>(k))) return k;
  }
  return std::nullopt;
}

Vec3 euler_angles(const Mat3& rotation, const EulerAxes& axes, const Vec3& near) {
  assert(are_euler_axes(axes));
  // In the basis of the axes the rotation is Rx(a) Ry(b) Rz(s c), or Rx(a) Ry(b) Rx(s c).
  Mat3 basis;
  basis << axes[0], axes[1], axes[0].cross(axes[1]);
  const Mat3 r = basis.transpose() * rotation * basis;
  const double along_first = axes[2].dot(axes[0]);
  const bool is_proper = std::abs(along_first) > 0.5;
  const double sign = (is_proper ? along_first : axes[2].dot(basis.col(2))) < 0 ? -1 : 1;

  // Vanishes when the outer axes coincide: the sine (proper) or the cosine of b.
  const double lock = is_proper ? std::hypot(r(0, 1), r(0, 2)) : std::hypot(r(0, 0), r(0, 1));
  const double b = is_proper ? std::atan2(lock, r(0, 0)) : std::atan2(r(0, 2), lock);
  // In gimbal lock only the sum or the difference of a and c is known, and a may be chosen.
  constexpr double kLocked = 1e-12;
  const double free_a = is_proper ? std::atan2(r(1, 0), -r(2, 0)) : std::atan2(-r(1, 2), r(2, 2));
  const double a = lock < kLocked ? near[0] : free_a;
  // Rx(-a) r is a rotation by (0, b, c), whose second row gives c. This c compensates the error of
  // an ill-conditioned a; c from the first row of r would not.
  const Vec3 row = std::cos(a) * r.row(1).transpose() + std::sin(a) * r.row(2).transpose();
  const double c = sign * (is_proper ? std::atan2(-row[2], row[1]) : std::atan2(row[0], row[1]));
  const Vec3 first = nearest_turns({a, b, c}, near, kTurn);
  if (lock < kLocked) return first;
  // The other triple of the same rotation: the middle angle has the opposite sign.
  const double pi = std::numbers::pi;
  const Vec3 second = nearest_turns({a + pi, is_proper ? -b : pi - b, c + pi}, near, kTurn);
  const bool is_second = (second - near).squaredNorm() < (first - near).squaredNorm();
  return is_second ? second : first;
}

double angle_between(const Quat& a, const Quat& b) {
  const Quat difference = a.conjugate() * b;
  return 2 * std::atan2(difference.vec().norm(), std::abs(difference.w()));
}

}  // namespace kinefile
