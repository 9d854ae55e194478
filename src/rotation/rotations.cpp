// SPDX-License-Identifier: MIT
#include "rotation/rotations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/turns.hpp"

namespace kinefile::rotation {
namespace {

simd::Vector vector_of(const Vec3& v) { return {v[0], v[1], v[2]}; }

simd::Matrix matrix_of(const Mat3& m) {
  return {vector_of(m.col(0)), vector_of(m.col(1)), vector_of(m.col(2))};
}

}  // namespace

simd::EulerForm euler_form(const EulerAxes& axes, bool is_in_degrees) {
  const double along_first = axes[2].dot(axes[0]);
  const bool is_proper = std::abs(along_first) > 0.5;
  const double along = is_proper ? along_first : axes[2].dot(axes[0].cross(axes[1]));
  const double right_angle = is_in_degrees ? 90 : std::numbers::pi / 2;
  return {along < 0 ? -1.0 : 1.0, is_proper ? 0 : right_angle, is_in_degrees};
}

Quat quaternion_at(const simd::Quaternions& q, std::size_t i) {
  return {q[0][i], q[1][i], q[2][i], q[3][i]};
}

void put_quaternion(const Quat& value, std::size_t i, simd::Quaternions& q) {
  q[0][i] = value.w();
  q[1][i] = value.x();
  q[2][i] = value.y();
  q[3][i] = value.z();
}

void turn_axes(const Mat3& turn, simd::Quaternions& quaternions) {
  simd::turn_axes(matrix_of(turn), quaternions);
}

simd::Matrix kernel_from_joint(const EulerAxes& axes) {
  Mat3 joint_from_kernel;
  joint_from_kernel << axes[0], axes[1], axes[0].cross(axes[1]);
  return matrix_of(joint_from_kernel.transpose());
}

AngleFinder::AngleFinder(const EulerAxes& axes, bool is_in_degrees, const Vec3& start)
    : form_(euler_form(axes, is_in_degrees)),
      kernel_from_joint_(kernel_from_joint(axes)),
      half_turn_(is_in_degrees ? 180 : std::numbers::pi) {
  if (start.allFinite()) last_.angles = vector_of(start);
}

/// \param plus, minus, middle  see `simd::half_angles_of_quaternions`
Vec3 AngleFinder::angles_near(double plus, double minus, double middle) const {
  const Vec3 before(last_.angles[0], last_.angles[1], last_.angles[2]);
  constexpr double kLocked = 1e-12;  // radians
  const double turn = 2 * half_turn_;
  const double locked = kLocked / std::numbers::pi * half_turn_;
  const bool is_at_start = middle < locked;
  const bool is_at_end = half_turn_ - middle < locked;
  if (is_at_start || is_at_end) {
    const double a = before[0];
    const double c = form_.sign * (is_at_start ? 2 * plus - a : a - 2 * minus);
    return {a, nearest_turn(form_.shift + middle, before[1], turn),
            nearest_turn(c, before[2], turn)};
  }
  const double a = plus + minus;
  const double c = form_.sign * (plus - minus);
  const Vec3 one = nearest_turns({a, form_.shift + middle, c}, before, turn);
  const Vec3 other =
      nearest_turns({a + half_turn_, form_.shift - middle, c + half_turn_}, before, turn);
  return (other - before).squaredNorm() < (one - before).squaredNorm() ? other : one;
}

void AngleFinder::find_one(std::size_t i, simd::Angles& angles) {
  const Vec3 halves(angles[0][i], angles[1][i], angles[2][i]);
  Vec3 found = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  if (halves.allFinite()) {
    found = angles_near(halves[0], halves[1], halves[2]);
    last_.angles = vector_of(found);
  }
  for (std::size_t k = 0; k < 3; ++k) angles[k][i] = found[static_cast<Eigen::Index>(k)];
}

void AngleFinder::find(simd::Quaternions& rotations, std::size_t count, simd::Angles& angles) {
  simd::turn_to_form(form_, kernel_from_joint_, rotations);
  simd::half_angles_of_quaternions(form_, rotations, angles);
  for (std::size_t i = 0; i < count;) {
    i = simd::follow_triples(form_, i, count, last_, angles);
    const std::size_t end = std::min(i + simd::kBlock, count);
    for (; i < end; ++i) find_one(i, angles);
  }
}

}  // namespace kinefile::rotation
