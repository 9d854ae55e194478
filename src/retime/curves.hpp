// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace kinefile::retime {

/// A point on a curve.
struct Knot {
  double x = 0;
  double y = 0;
};

/// Slopes at two or more knots with increasing x, with which the cubic pieces between them are
/// monotone where the knots are; shape (knots). At local extrema of the knots the slope is 0.
/// Source: Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5 (1984), in the weighted form of PCHIP;
/// at the ends the slope of the parabola through three knots, limited so that it is monotone.
std::vector<double> pchip_slopes(const std::vector<Knot>& knots);

/// As `pchip_slopes`. Source: Steffen, Astron. Astrophys. 239 (1990).
std::vector<double> steffen_slopes(const std::vector<Knot>& knots);

/// A slope clamped to the range for the end of a monotone piece: from 0 to three times the slope
/// from one knot to the other. Source: Fritsch and Carlson, SIAM J. Numer. Anal. 17 (1980).
double monotone_slope(double slope, const Knot& from, const Knot& to);

/// The line through two knots, exact if the exact result is a double.
double straight_at(const Knot& from, const Knot& to, double x);

/// The cubic between two knots with given slopes.
double cubic_at(const Knot& from, double from_slope, const Knot& to, double to_slope, double x);

}  // namespace kinefile::retime
