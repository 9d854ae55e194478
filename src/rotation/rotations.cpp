// SPDX-License-Identifier: MIT
#include "rotation/rotations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/turns.hpp"
#include "simd/forward_kinematics.hpp"

namespace kinefile::rotation {
namespace {

/// The components of quaternions, in separate arrays.
struct Pointers {
  explicit Pointers(simd::Quaternions& q)
      : w(q[0].data()), x(q[1].data()), y(q[2].data()), z(q[3].data()) {}

  double* __restrict w;
  double* __restrict x;
  double* __restrict y;
  double* __restrict z;
};

/// Multiplies quaternions by rotations about an axis, on the right.
void multiply(const Vec3& axis, const std::vector<double>& sines,
              const std::vector<double>& cosines, simd::Quaternions& q) {
  const double ax = axis[0], ay = axis[1], az = axis[2];
  const Pointers to(q);
  const double* __restrict sine = sines.data();
  const double* __restrict cosine = cosines.data();
  for (std::size_t i = 0; i < sines.size(); ++i) {
    const double w = to.w[i], x = to.x[i], y = to.y[i], z = to.z[i];
    const double c = cosine[i], s = sine[i];
    to.w[i] = c * w - s * (ax * x + ay * y + az * z);
    to.x[i] = c * x + s * (ax * w + az * y - ay * z);
    to.y[i] = c * y + s * (ay * w + ax * z - az * x);
    to.z[i] = c * z + s * (az * w + ay * x - ax * y);
  }
}

/// Converts rotations to the kernel's form (see `simd::EulerForm`): the basis of the axes and, for
/// three different axes, a quarter turn back about the second; not normalised.
void to_kernel(const Mat3& kernel_from_joint, bool has_quarter_turn, simd::Quaternions& q) {
  turn_axes(kernel_from_joint, q);
  if (!has_quarter_turn) return;
  const Pointers to(q);
  for (std::size_t i = 0; i < q[0].size(); ++i) {
    const double w = to.w[i], x = to.x[i], y = to.y[i], z = to.z[i];
    to.w[i] = w + y;
    to.x[i] = x + z;
    to.y[i] = y - w;
    to.z[i] = z - x;
  }
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

void products_of_rotations(std::span<const Vec3> axes, const AngleColumns& angles,
                           std::size_t count, bool is_in_degrees, simd::Quaternions& out) {
  resize(out, count);
  std::fill(out[0].begin(), out[0].end(), 1.0);
  for (std::size_t k = 1; k < 4; ++k) std::fill(out[k].begin(), out[k].end(), 0.0);
  std::vector<double> halves(out[0].size());
  std::vector<double> sines(halves.size());
  std::vector<double> cosines(halves.size());
  for (std::size_t a = 0; a < axes.size(); ++a) {
    std::transform(angles[a].begin(), angles[a].end(), halves.begin(),
                   [](double angle) { return 0.5 * angle; });
    simd::sincos(halves.data(), halves.size(), is_in_degrees, sines.data(), cosines.data());
    multiply(axes[a], sines, cosines, out);
  }
}

void turn_axes(const Mat3& turn, simd::Quaternions& quaternions) {
  const Pointers to(quaternions);
  for (std::size_t i = 0; i < quaternions[0].size(); ++i) {
    const double x = to.x[i], y = to.y[i], z = to.z[i];
    to.x[i] = turn(0, 0) * x + turn(0, 1) * y + turn(0, 2) * z;
    to.y[i] = turn(1, 0) * x + turn(1, 1) * y + turn(1, 2) * z;
    to.z[i] = turn(2, 0) * x + turn(2, 1) * y + turn(2, 2) * z;
  }
}

AngleFinder::AngleFinder(const EulerAxes& axes, bool is_in_degrees, const Vec3& start)
    : form_(euler_form(axes, is_in_degrees)),
      half_turn_(is_in_degrees ? 180 : std::numbers::pi),
      before_(start.allFinite() ? start : Vec3(Vec3::Zero())) {
  kernel_from_joint_ << axes[0], axes[1], axes[0].cross(axes[1]);
  kernel_from_joint_.transposeInPlace();
}

/// \param plus, minus, middle  see `simd::half_angles_of_quaternions`
Vec3 AngleFinder::angles_near(double plus, double minus, double middle) const {
  constexpr double kLocked = 1e-12;  // radians
  const double turn = 2 * half_turn_;
  const double locked = kLocked / std::numbers::pi * half_turn_;
  const bool is_at_start = middle < locked;
  const bool is_at_end = half_turn_ - middle < locked;
  if (is_at_start || is_at_end) {
    const double a = before_[0];
    const double c = form_.sign * (is_at_start ? 2 * plus - a : a - 2 * minus);
    return {a, nearest_turn(form_.shift + middle, before_[1], turn),
            nearest_turn(c, before_[2], turn)};
  }
  const double a = plus + minus;
  const double c = form_.sign * (plus - minus);
  const Vec3 one = nearest_turns({a, form_.shift + middle, c}, before_, turn);
  const Vec3 other =
      nearest_turns({a + half_turn_, form_.shift - middle, c + half_turn_}, before_, turn);
  return (other - before_).squaredNorm() < (one - before_).squaredNorm() ? other : one;
}

void AngleFinder::find(simd::Quaternions& rotations, std::size_t count, simd::Angles& angles) {
  to_kernel(kernel_from_joint_, form_.shift != 0, rotations);
  simd::half_angles_of_quaternions(form_, rotations, angles);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 halves(angles[0][i], angles[1][i], angles[2][i]);
    Vec3 found = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    if (halves.allFinite()) found = before_ = angles_near(halves[0], halves[1], halves[2]);
    for (std::size_t k = 0; k < 3; ++k) angles[k][i] = found[static_cast<Eigen::Index>(k)];
  }
}

}  // namespace kinefile::rotation
