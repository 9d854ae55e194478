// SPDX-License-Identifier: MIT
#include "formats/table_rate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kinefile/timeline.hpp"

namespace kinefile {
namespace {

/// Times as they are printed.
struct PrintedTimes {
  std::span<const double> times;
  std::span<const double> half_digits;
};

/// Where the first of some frames may be.
enum class Start {
  AtZero,   ///< exactly at 0 s
  Anywhere  ///< near the first time
};

/// How far a time may be from its frame.
double slack_of(const PrintedTimes& printed, std::size_t i, double period) {
  constexpr double kMost = 0.125;     // of a period
  constexpr double kRounding = 1e-9;  // of a period, by arithmetic
  return std::min(printed.half_digits[i], kMost * period) + kRounding * period;
}

/// How far the first of consecutive frames can be shifted with every time still at its frame;
/// below 0 if they fit nowhere.
double room_of(const PrintedTimes& printed, double period, Start start) {
  double earliest = start == Start::AtZero ? 0 : -std::numeric_limits<double>::infinity();
  double latest = -earliest;
  for (std::size_t i = 0; i < printed.times.size(); ++i) {
    const double first = printed.times[i] - static_cast<double>(i) * period;
    const double slack = slack_of(printed, i, period);
    earliest = std::max(earliest, first - slack);
    latest = std::min(latest, first + slack);
  }
  return latest - earliest;
}

bool do_fit(const PrintedTimes& printed, double rate, Start start) {
  return room_of(printed, 1 / rate, start) >= 0;
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

/// A range of periods.
struct Periods {
  double least;
  double greatest;
};

/// The period with the most room in a range.
double roomiest(const PrintedTimes& printed, Periods range, Start start) {
  constexpr int kSteps = 60;
  // The room is concave.
  for (int step = 0; step < kSteps; ++step) {
    const double third = (range.greatest - range.least) / 3;
    const double a = range.least + third;
    const double b = range.greatest - third;
    if (room_of(printed, a, start) < room_of(printed, b, start)) {
      range.least = a;
    } else {
      range.greatest = b;
    }
  }
  return 0.5 * (range.least + range.greatest);
}

/// The last period that fits on the way from one that fits to one that does not.
double border(const PrintedTimes& printed, double inside, double outside, Start start) {
  constexpr int kSteps = 50;
  for (int step = 0; step < kSteps; ++step) {
    const double middle = 0.5 * (inside + outside);
    (room_of(printed, middle, start) >= 0 ? inside : outside) = middle;
  }
  return inside;
}

/// All periods that fit.
/// \param mean  from the first time to the last
std::optional<Periods> fitting_periods(const PrintedTimes& printed, double mean, Start start) {
  const std::size_t last = printed.times.size() - 1;
  const double reach = slack_of(printed, 0, mean) + slack_of(printed, last, mean);
  // No other period brings more room than this.
  if (room_of(printed, mean, start) + reach < 0) return std::nullopt;
  const double width = reach / static_cast<double>(last);
  const Periods range{mean - width, mean + width};
  const double inside = roomiest(printed, range, start);
  if (!(room_of(printed, inside, start) >= 0)) return std::nullopt;
  return Periods{border(printed, inside, range.least, start),
                 border(printed, inside, range.greatest, start)};
}

/// The rate with the fewest decimals that fits; 0 if none does.
double shortest_rate(const PrintedTimes& printed, double mean, Start start) {
  const auto periods = fitting_periods(printed, mean, start);
  if (!periods) return 0;
  const double least = 1 / periods->greatest;
  const double greatest = 1 / periods->least;
  const double middle = 0.5 * (least + greatest);
  for (double scale = 1; scale <= 1e9; scale *= 10) {
    const double rate = std::round(middle * scale) / scale;
    if (rate > 0 && rate >= least && rate <= greatest) return rate;
  }
  return middle;
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

double power_of_ten(double exponent) {
  static const std::array<double, 20> kUsual = [] {
    std::array<double, 20> powers;
    for (std::size_t i = 0; i < powers.size(); ++i) {
      powers[i] = std::pow(10.0, -static_cast<double>(i));
    }
    return powers;
  }();
  const bool is_usual = exponent <= 0 && -exponent < static_cast<double>(kUsual.size());
  return is_usual ? kUsual[static_cast<std::size_t>(-exponent)] : std::pow(10.0, exponent);
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
  return 0.5 * power_of_ten(exponent - digits);
}

std::optional<double> rate_of_times(std::span<const double> times,
                                    std::span<const double> half_digits) {
  const double period = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  const double estimate = 1 / period;
  if (!(estimate >= kLeastTableRate && estimate <= kMostTableRate)) return std::nullopt;
  const PrintedTimes printed{times, half_digits};
  const Start start = times.front() == 0 ? Start::AtZero : Start::Anywhere;
  if (const double rate = usual_rate(printed, estimate, start); rate > 0) return rate;
  if (are_steady(times, period)) return near_whole(estimate);
  if (const double rate = usual_rate(printed, estimate, Start::Anywhere); rate > 0) return rate;
  if (const double rate = shortest_rate(printed, period, start); rate > 0) return rate;
  if (const double rate = shortest_rate(printed, period, Start::Anywhere); rate > 0) return rate;
  if (const double rate = rate_of_coarse_times(times); rate > 0) return rate;
  return std::nullopt;
}

}  // namespace kinefile
