// SPDX-License-Identifier: MIT
#include <cmath>

#include "kinefile/math.hpp"

namespace kinefile {
namespace {

Quat negated(const Quat& q) { return {-q.w(), -q.x(), -q.y(), -q.z()}; }

Quat weighted_sum(const Quat& a, double weight_a, const Quat& b, double weight_b) {
  return Quat(Quat::Coefficients(weight_a * a.coeffs() + weight_b * b.coeffs()));
}

/// Along the great circle from `a` to `b`, not to -b.
Quat slerp_one_way(const Quat& a, const Quat& b, double t) {
  // atan2 keeps its digits where acos loses them: near 0 and near 180 degrees.
  const double cosine = a.dot(b);
  const Quat::Coefficients across = b.coeffs() - cosine * a.coeffs();
  const double sine = across.norm();
  constexpr double kNearlyEqual = 1e-8;  // the chord differs from the arc by less than a bit
  if (sine < kNearlyEqual) {
    if (cosine < 0) return a;  // opposite: every path has the same length
    return weighted_sum(a, 1 - t, b, t).normalized();
  }
  const double angle = std::atan2(sine, cosine);
  return Quat(Quat::Coefficients(std::cos(t * angle) * a.coeffs() +
                                 (std::sin(t * angle) / sine) * across))
      .normalized();
}

}  // namespace

Quat unit_quaternion(const Quat& q) {
  constexpr double kLeastSquare = 1e-200, kLargestSquare = 1e200;  // within them no digit is lost
  const double square = q.squaredNorm();
  if (square >= kLeastSquare && square <= kLargestSquare) {
    return Quat(Quat::Coefficients(q.coeffs() / std::sqrt(square)));
  }
  const double largest = q.coeffs().cwiseAbs().maxCoeff();
  if (square == 0 && largest == 0) return Quat::Identity();
  const Quat::Coefficients scaled = q.coeffs() / largest;
  return Quat(Quat::Coefficients(scaled / scaled.norm()));
}

Quat on_side_of(const Quat& q, const Quat& near) { return q.dot(near) < 0 ? negated(q) : q; }

Quat slerp(const Quat& a, const Quat& b, double t) { return slerp_one_way(a, on_side_of(b, a), t); }

Quat nlerp(const Quat& a, const Quat& b, double t) {
  return weighted_sum(a, 1 - t, on_side_of(b, a), t).normalized();
}

Vec3 log_of(const Quat& q) {
  const double sine = q.vec().norm();
  // The nearer of q and -q, so that the vector is at most a quarter turn.
  const double angle = std::atan2(sine, std::abs(q.w()));
  const double sign = q.w() < 0 ? -1 : 1;
  constexpr double kSmall = 1e-150;
  return sine < kSmall ? Vec3(sign * q.vec()) : Vec3(sign * angle / sine * q.vec());
}

Quat exp_of(const Vec3& v) {
  const double angle = v.norm();
  constexpr double kSmall = 1e-150;
  const double factor = angle < kSmall ? 1 : std::sin(angle) / angle;
  const Vec3 vec = factor * v;
  return {std::cos(angle), vec[0], vec[1], vec[2]};
}

Quat squad_control(const Quat& before, const Quat& at, const Quat& after) {
  const Quat inverse = at.conjugate();
  return at * exp_of(-0.25 * (log_of(inverse * after) + log_of(inverse * before)));
}

Quat squad(const Quat& a, const Quat& control_a, const Quat& control_b, const Quat& b, double t) {
  const Quat outer = slerp_one_way(a, b, t);
  const Quat inner = slerp_one_way(control_a, control_b, t);
  return slerp_one_way(outer, inner, 2 * t * (1 - t));
}

}  // namespace kinefile
