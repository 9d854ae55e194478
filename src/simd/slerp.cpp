// SPDX-License-Identifier: MIT
#include "simd/slerp.hpp"

#include <cmath>
#include <numbers>

namespace kinefile::simd {
namespace {

double nearest_turn(double angle, double near, double turn) {
  return angle + turn * std::round((near - angle) / turn);
}

template <class Weights>
void interpolate(const Quaternions& quaternions, const std::vector<Between>& places,
                 Quaternions& out, Weights weights) {
  for (auto& component : out) component.resize(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Between& place = places[i];
    double cosine = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      cosine += quaternions[k][place.from] * quaternions[k][place.to];
    }
    const double side = cosine < 0 ? -1 : 1;
    const auto [weight_from, weight_to] = weights(std::abs(cosine), place.t);
    for (std::size_t k = 0; k < 4; ++k) {
      out[k][i] =
          weight_from * quaternions[k][place.from] + side * weight_to * quaternions[k][place.to];
    }
  }
}

}  // namespace

void quaternions_of_angles(const EulerForm& form, const Angles& angles, Quaternions& quaternions) {
  const double unit = form.is_in_degrees ? std::numbers::pi / 180 : 1;
  const std::size_t count = angles[0].size();
  for (auto& component : quaternions) component.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double p = 0.5 * unit * (angles[0][i] + form.sign * angles[2][i]);
    const double m = 0.5 * unit * (angles[0][i] - form.sign * angles[2][i]);
    const double b = 0.5 * unit * (angles[1][i] - form.shift);
    quaternions[0][i] = std::cos(b) * std::cos(p);
    quaternions[1][i] = std::cos(b) * std::sin(p);
    quaternions[2][i] = std::sin(b) * std::cos(m);
    quaternions[3][i] = std::sin(b) * std::sin(m);
  }
}

void angles_of_quaternions(const EulerForm& form, const Quaternions& q, Angles& angles) {
  const double unit = form.is_in_degrees ? std::numbers::pi / 180 : 1;
  const double turn = form.is_in_degrees ? 360 : 2 * std::numbers::pi;
  for (std::size_t i = 0; i < angles[0].size(); ++i) {
    const double near[3] = {angles[0][i], angles[1][i], angles[2][i]};
    const double outer = std::hypot(q[0][i], q[1][i]);
    const double inner = std::hypot(q[2][i], q[3][i]);
    constexpr double kLocked = 1e-13;
    const double p = outer <= kLocked * inner ? 0.5 * (near[0] + form.sign * near[2])
                                              : std::atan2(q[1][i], q[0][i]) / unit;
    const double m = inner <= kLocked * outer ? 0.5 * (near[0] - form.sign * near[2])
                                              : std::atan2(q[3][i], q[2][i]) / unit;
    const double b = 2 * std::atan2(inner, outer) / unit;
    const double a = p + m;
    const double c = form.sign * (p - m);
    const double first[3] = {nearest_turn(a, near[0], turn),
                             nearest_turn(form.shift + b, near[1], turn),
                             nearest_turn(c, near[2], turn)};
    const double second[3] = {nearest_turn(a + turn / 2, near[0], turn),
                              nearest_turn(form.shift - b, near[1], turn),
                              nearest_turn(c + turn / 2, near[2], turn)};
    double nearer = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      nearer += (second[k] - near[k]) * (second[k] - near[k]) -
                (first[k] - near[k]) * (first[k] - near[k]);
    }
    for (std::size_t k = 0; k < 3; ++k) angles[k][i] = nearer < 0 ? second[k] : first[k];
  }
}

void slerp(const Quaternions& quaternions, const std::vector<Between>& places, Quaternions& out) {
  interpolate(quaternions, places, out, [](double cosine, double t) {
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const double angle = std::atan2(sine, cosine);
    if (sine < 1e-6) return std::pair(1 - t, t);
    return std::pair(std::sin((1 - t) * angle) / sine, std::sin(t * angle) / sine);
  });
}

void nlerp(const Quaternions& quaternions, const std::vector<Between>& places, Quaternions& out) {
  interpolate(quaternions, places, out, [](double, double t) { return std::pair(1 - t, t); });
}

void atan2(const std::vector<double>& y, const std::vector<double>& x,
           std::vector<double>& angles) {
  angles.resize(y.size());
  for (std::size_t i = 0; i < y.size(); ++i) angles[i] = std::atan2(y[i], x[i]);
}

}  // namespace kinefile::simd
