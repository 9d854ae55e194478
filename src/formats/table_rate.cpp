// SPDX-License-Identifier: MIT
#include "formats/table_rate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinefile/timeline.hpp"

namespace kinefile {
namespace {

/// Printed times.
struct PrintedTimes {
  std::span<const double> times;
  std::span<const double> half_digits;
};

/// Where the first of some frames may be.
enum class Start {
  AtZero,   ///< exactly at 0 s
  Anywhere  ///< near the first time
};

/// Whether times are those of consecutive frames at a rate, within the rounding of their digits.
bool do_fit(const PrintedTimes& printed, double rate, Start start) {
  constexpr double kMost = 0.125;     // of a period
  constexpr double kRounding = 1e-9;  // of a period, by arithmetic
  double earliest = start == Start::AtZero ? 0 : -std::numeric_limits<double>::infinity();
  double latest = -earliest;
  for (std::size_t i = 0; i < printed.times.size() && earliest <= latest; ++i) {
    const double first = printed.times[i] - static_cast<double>(i) / rate;
    const double slack = std::min(printed.half_digits[i], kMost / rate) + kRounding / rate;
    earliest = std::max(earliest, first - slack);
    latest = std::min(latest, first + slack);
  }
  return earliest <= latest;
}

/// The rate nearest to an estimate that fits; 0 if none does.
double nearest_that_fits(const PrintedTimes& printed, std::span<const double> rates,
                         double estimate, Start start) {
  double nearest = 0;
  for (const double rate : rates) {
    const bool is_nearer = std::abs(rate - estimate) < std::abs(nearest - estimate);
    if (is_nearer && do_fit(printed, rate, start)) nearest = rate;
  }
  return nearest;
}

double usual_rate(const PrintedTimes& printed, double estimate, Start start) {
  const double whole = nearest_that_fits(printed, usual_rates(), estimate, start);
  if (whole > 0) return whole;
  return nearest_that_fits(printed, television_rates(), estimate, start);
}

/// The rate with the fewest decimals that fits; 0 if none does.
double shortest_rate(const PrintedTimes& printed, double estimate, Start start) {
  for (double scale = 1; scale <= 1e9; scale *= 10) {
    const double rate = std::round(estimate * scale) / scale;
    if (rate > 0 && do_fit(printed, rate, start)) return rate;
  }
  return 0;
}

/// Whether times have equal distances of one period, but for arithmetic.
bool are_steady(std::span<const double> times, double period) {
  constexpr double kLoose = 1e-3;  // of a period
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double expected = times.front() + static_cast<double>(i) * period;
    if (std::abs(times[i] - expected) > kLoose * period) return false;
  }
  return true;
}

/// A rate, or the whole one that it is within a ten-thousandth.
double near_whole(double rate) {
  constexpr double kWhole = 1e-4;
  const double whole = std::round(rate);
  return whole >= 1 && std::abs(rate - whole) <= kWhole * whole ? whole : rate;
}

/// The usual rate of times with few digits whose frames, counted from 0 s, follow each other.
double rate_of_coarse_times(std::span<const double> times) {
  const auto usual = steady_rate(times);
  if (!usual || !usual->holds_times) return 0;
  const double first = *frame_that_holds(times.front(), usual->per_second);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double frame = first + static_cast<double>(i);
    if (*frame_that_holds(times[i], usual->per_second) != frame) return 0;
    if (std::abs(times[i] * usual->per_second - frame) > 0.5) return 0;
  }
  return usual->per_second;
}

}  // namespace

double half_of_last_digit(const char* at, const char* end) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  at = std::find_if(at, end, [&](char c) { return is_digit(c) || c == '.'; });
  at = std::find_if_not(at, end, is_digit);
  double digits = 0;
  if (at != end && *at == '.') {
    const char* const point = at++;
    at = std::find_if_not(at, end, is_digit);
    digits = static_cast<double>(at - point - 1);
  }
  double exponent = 0;
  if (at != end && (*at == 'e' || *at == 'E')) {
    ++at;
    const bool is_negative = at != end && *at == '-';
    if (at != end && (*at == '-' || *at == '+')) ++at;
    for (; at != end && is_digit(*at); ++at) exponent = 10 * exponent + (*at - '0');
    if (is_negative) exponent = -exponent;
  }
  return 0.5 * std::pow(10.0, exponent - digits);
}

std::optional<double> rate_of_times(std::span<const double> times,
                                    std::span<const double> half_digits) {
  constexpr double kLeastRate = 1e-9, kGreatestRate = 1e9;
  const double period = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  const double estimate = 1 / period;
  if (!(estimate >= kLeastRate && estimate <= kGreatestRate)) return std::nullopt;
  const PrintedTimes printed{times, half_digits};
  const Start start = times.front() == 0 ? Start::AtZero : Start::Anywhere;
  if (const double rate = usual_rate(printed, estimate, start); rate > 0) return rate;
  if (are_steady(times, period)) return near_whole(estimate);
  if (const double rate = shortest_rate(printed, estimate, start); rate > 0) return rate;
  if (const double rate = usual_rate(printed, estimate, Start::Anywhere); rate > 0) return rate;
  if (const double rate = shortest_rate(printed, estimate, Start::Anywhere); rate > 0) return rate;
  if (const double rate = rate_of_coarse_times(times); rate > 0) return rate;
  return std::nullopt;
}

}  // namespace kinefile
