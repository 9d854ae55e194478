// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace kinefile::retime {

/// A point that a curve goes through.
struct Knot {
  double x = 0;
  double y = 0;
};

/// Slopes at knots with rising x, two or more, with which the cubic pieces between them are as
/// monotone as the knots; shape (knots). Where the knots turn round the slope is 0.
/// Source: Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5 (1984), in the weighted form of PCHIP;
/// at the ends the slope of the parabola through three knots, as far as that is monotone.
std::vector<double> pchip_slopes(const std::vector<Knot>& knots);

/// As `pchip_slopes`. Source: Steffen, Astron. Astrophys. 239 (1990).
std::vector<double> steffen_slopes(const std::vector<Knot>& knots);

/// A slope brought into what a monotone piece may have at its end: from 0 to three times the slope
/// from one knot to the other. Source: Fritsch and Carlson, SIAM J. Numer. Anal. 17 (1980).
double monotone_slope(double slope, const Knot& from, const Knot& to);

/// The straight line through two knots, exact where the exact result is a number.
double straight_at(const Knot& from, const Knot& to, double x);

/// The cubic between two knots with slopes at them.
double cubic_at(const Knot& from, double from_slope, const Knot& to, double to_slope, double x);

}  // namespace kinefile::retime
