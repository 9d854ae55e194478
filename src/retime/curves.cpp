// SPDX-License-Identifier: MIT
#include "retime/curves.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kinefile::retime {
namespace {

/// The widths and the slopes of the line segments from knot to knot.
struct Secants {
  std::vector<double> widths;
  std::vector<double> slopes;
};

Secants secants_of(const std::vector<Knot>& knots) {
  Secants secants;
  for (std::size_t j = 0; j + 1 < knots.size(); ++j) {
    secants.widths.push_back(knots[j + 1].x - knots[j].x);
    secants.slopes.push_back((knots[j + 1].y - knots[j].y) / secants.widths.back());
  }
  return secants;
}

double sign_of(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

/// The slope at the end of piece `at`, of the parabola through its knots and the one after `next`,
/// limited so that it is monotone.
double end_slope(const Secants& secants, std::size_t at, std::size_t next, double most) {
  const double h0 = secants.widths[at];
  const double h1 = secants.widths[next];
  const double d0 = secants.slopes[at];
  const double d1 = secants.slopes[next];
  const double slope = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (sign_of(slope) != sign_of(d0)) return 0;
  return std::abs(slope) > most * std::abs(d0) ? most * d0 : slope;
}

/// Slopes by a formula for the inner knots.
/// \param most  the largest ratio of the slope at an end to the slope of its piece
template <class InnerSlope>
std::vector<double> slopes_by(const std::vector<Knot>& knots, double most, InnerSlope inner) {
  const Secants secants = secants_of(knots);
  const std::size_t num_pieces = secants.slopes.size();
  if (num_pieces < 2) return std::vector<double>(knots.size(), num_pieces ? secants.slopes[0] : 0);
  std::vector<double> slopes = {end_slope(secants, 0, 1, most)};
  for (std::size_t j = 1; j < num_pieces; ++j) {
    slopes.push_back(
        inner(secants.widths[j - 1], secants.widths[j], secants.slopes[j - 1], secants.slopes[j]));
  }
  slopes.push_back(end_slope(secants, num_pieces - 1, num_pieces - 2, most));
  return slopes;
}

}  // namespace

std::vector<double> pchip_slopes(const std::vector<Knot>& knots) {
  return slopes_by(knots, 3, [](double h0, double h1, double d0, double d1) {
    if (sign_of(d0) * sign_of(d1) <= 0) return 0.0;
    const double w0 = 2 * h1 + h0;
    const double w1 = h1 + 2 * h0;
    return (w0 + w1) / (w0 / d0 + w1 / d1);
  });
}

std::vector<double> steffen_slopes(const std::vector<Knot>& knots) {
  return slopes_by(knots, 2, [](double h0, double h1, double d0, double d1) {
    const double parabola = (d0 * h1 + d1 * h0) / (h0 + h1);
    const double least = std::min({std::abs(d0), std::abs(d1), std::abs(parabola) / 2});
    return (sign_of(d0) + sign_of(d1)) * least;
  });
}

double monotone_slope(double slope, const Knot& from, const Knot& to) {
  const double secant = (to.y - from.y) / (to.x - from.x);
  if (sign_of(slope) != sign_of(secant)) return 0;
  return sign_of(secant) * std::min(std::abs(slope), 3 * std::abs(secant));
}

double straight_at(const Knot& from, const Knot& to, double x) {
  // Multiplying first keeps whole results whole.
  return from.y + (x - from.x) * (to.y - from.y) / (to.x - from.x);
}

double cubic_at(const Knot& from, double from_slope, const Knot& to, double to_slope, double x) {
  const double h = to.x - from.x;
  const double t = (x - from.x) / h;
  const double s = 1 - t;
  const double rise = t * t * (3 - 2 * t) * (to.y - from.y);
  return from.y + rise + h * t * s * (s * from_slope - t * to_slope);
}

}  // namespace kinefile::retime
