// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

namespace kinefile {

/// The printed decimal number at a place in a text, as far as its precision goes.
/// \returns half a unit of its last digit: 0.0005 of "0.050", 0.005 of "1.20e+01"; 0.5 without
///          digits
double half_of_last_digit(const char* at, const char* end);

/// The rates that times are taken for, in frames a second.
inline constexpr double kLeastTableRate = 1e-9, kMostTableRate = 1e9;

/// The steady rate of two or more times that go up, if they have one: every time is that of its
/// frame, within the rounding of its last digit. Of the rates that fit, a usual one (see
/// `usual_rates`, `television_rates`) comes first, then the one with the fewest decimals. Times
/// that begin at 0 count from there; others, and times whose last digits were cut off, may all be
/// late by the same part of a digit. Digits that are coarser than an eighth of a period count as if
/// they were not, so that a missing frame is noticed.
/// \param half_digits  of each time, see `half_of_last_digit`
std::optional<double> rate_of_times(std::span<const double> times,
                                    std::span<const double> half_digits);

}  // namespace kinefile
