// SPDX-License-Identifier: MIT
#include "kinefile/timeline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace kinefile {
namespace {

constexpr double kSameRate = 1e-5;  // of the rate

/// The decimal notation of a positive number.
struct Decimals {
  double unit = 0;     ///< of the last decimal place; 0 if there are more than 15 digits
  int num_digits = 0;  ///< significant digits: without leading zeros
};

Decimals decimals_of(double value) {
  value = std::abs(value);
  if (value == 0) return {1, 1};
  double scale = 1;  // a power of ten, exact up to 10^22
  for (int places = 0; places <= 22; ++places) {
    const double digits = std::round(value * scale);
    if (digits >= 1e15) break;
    if (digits / scale == value) {
      return {1 / scale, static_cast<int>(std::floor(std::log10(digits))) + 1};
    }
    scale *= 10;
  }
  return {};
}

/// Whether a frame time is that of a rate: exactly, truncated or rounded to its last place.
bool stands_for(double time, const Decimals& decimals, double rate) {
  constexpr int kFewestDigits = 3;  // 0.03 may be intended
  if (1 / rate == time) return true;
  const double lost = (1 / rate - time) / decimals.unit;
  return decimals.num_digits >= kFewestDigits && lost > -0.5001 && lost < 1;
}

/// Whether a rate is a whole one but for the spelling of its frame time. No two rates in use are so
/// close to each other.
bool is_nearly(double rate, double whole) {
  constexpr double kHighestSpelt = 1000;  // above it every rate is close to a whole one
  return whole <= kHighestSpelt && std::abs(rate - whole) <= kSameRate * whole;
}

/// Whether every time matches a frame, counted from 0 s, and the frames are strictly increasing.
bool hold_all(std::span<const double> times, double frame_rate) {
  double before = -std::numeric_limits<double>::infinity();
  for (const double time : times) {
    const auto frame = frame_that_holds(time, frame_rate);
    if (!frame || *frame <= before) return false;
    before = *frame;
  }
  return true;
}

bool do_rise(std::span<const double> times) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || (i > 0 && !(times[i] > times[i - 1]))) return false;
  }
  return true;
}

/// The whole number that a frame equals except for arithmetic rounding, otherwise the frame.
double without_rounding(double frame) {
  const double whole = std::round(frame);
  return std::abs(frame - whole) <= 1e-12 * std::max(1.0, std::abs(whole)) ? whole : frame;
}

}  // namespace

const Array<double>& own_times(const Timeline& timeline) {
  static const Array<double> kNone;
  const FrameTimes* own = std::get_if<FrameTimes>(&timeline.given);
  return own == nullptr ? kNone : own->seconds;
}

bool has_own_times(const Timeline& timeline) {
  return std::holds_alternative<FrameTimes>(timeline.given);
}

bool have_same_times(const Timeline& a, const Timeline& b) {
  if (has_own_times(a) != has_own_times(b)) return false;
  return has_own_times(a) ? own_times(a) == own_times(b) : have_same_rate(a, b);
}

bool have_same_rate(const Timeline& a, const Timeline& b) {
  const auto are_same = [](double x, double y) {
    return x == y || std::abs(x - y) <= kSameRate * std::abs(x);
  };
  return are_same(frame_rate(a), frame_rate(b)) ||
         are_same(nominal_frame_rate(a), nominal_frame_rate(b));
}

double frame_time(const Timeline& timeline) {
  const FrameTime* time = std::get_if<FrameTime>(&timeline.given);
  return time != nullptr ? time->seconds : 1 / frame_rate(timeline);
}

double frame_rate(const Timeline& timeline) {
  if (const FrameTime* time = std::get_if<FrameTime>(&timeline.given)) return 1 / time->seconds;
  if (const FrameRate* rate = std::get_if<FrameRate>(&timeline.given)) return rate->per_second;
  const FrameTimes& own = *std::get_if<FrameTimes>(&timeline.given);
  if (own.per_second) return *own.per_second;
  const auto steady = steady_rate(own.seconds);
  return steady ? steady->per_second : 0;
}

double nominal_frame_rate(const Timeline& timeline) {
  const double rate = frame_rate(timeline);
  constexpr double kHighestRate = 1e9;
  const FrameTime* given = std::get_if<FrameTime>(&timeline.given);
  if (given == nullptr || !(rate > 0 && rate < kHighestRate)) return rate;
  const Decimals decimals = decimals_of(given->seconds);
  const double whole = std::round(rate);
  if (whole >= 1 && (is_nearly(rate, whole) || stands_for(given->seconds, decimals, whole))) {
    return whole;
  }
  for (const double slowed : television_rates()) {
    if (stands_for(given->seconds, decimals, slowed)) return slowed;
  }
  return rate;
}

std::span<const double> usual_rates() {
  static constexpr std::array<double, 17> kRates = {1,  2,   5,   10,  20,  24,  25,  30,  50,
                                                    60, 100, 120, 200, 240, 250, 500, 1000};
  return kRates;
}

std::span<const double> television_rates() {
  static constexpr std::array<double, 4> kRates = {24.0 * 1000 / 1001, 30.0 * 1000 / 1001,
                                                   60.0 * 1000 / 1001, 120.0 * 1000 / 1001};
  return kRates;
}

std::optional<SteadyRate> steady_rate(std::span<const double> times) {
  if (!do_rise(times)) return std::nullopt;
  for (const double rate : usual_rates()) {
    if (hold_all(times, rate)) return SteadyRate{rate, true};
  }
  const double rate = 1 / median_step(times);
  if (!(rate > 0) || !std::isfinite(rate)) return std::nullopt;
  return SteadyRate{rate, false};
}

std::optional<double> frame_that_holds(double time, double frame_rate) {
  constexpr double kRounding = 1e-9;  // of a period
  const double frame = std::round(time * frame_rate);
  const double slack = 0.5 * decimals_of(time).unit + kRounding / frame_rate;
  if (!(std::abs(time - frame / frame_rate) <= slack)) return std::nullopt;
  return frame;
}

double median_step(std::span<const double> times) {
  if (times.size() < 2) return 0;
  std::vector<double> steps;
  steps.reserve(times.size() - 1);
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>((steps.size() - 1) / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

double time_of_frame(const Timeline& timeline, std::size_t frame) {
  const auto number = static_cast<double>(frame);
  if (const FrameTime* time = std::get_if<FrameTime>(&timeline.given)) {
    return number * time->seconds;
  }
  // Dividing by a rate is exact where multiplying by its rounded inverse is not.
  if (const FrameRate* rate = std::get_if<FrameRate>(&timeline.given)) {
    return number / rate->per_second;
  }
  const Array<double>& times = own_times(timeline);
  if (frame < times.size()) return times[frame];
  if (times.empty()) return 0;
  return times.back() + static_cast<double>(frame + 1 - times.size()) * median_step(times);
}

FramePosition position_in_time(std::span<const double> times, double seconds) {
  const auto next = std::upper_bound(times.begin(), times.end(), seconds);
  if (next == times.begin()) return {};
  const auto before = static_cast<std::size_t>(next - times.begin()) - 1;
  if (next == times.end()) return {before, 0};
  const double share = (seconds - times[before]) / (*next - times[before]);
  // Only times that are not increasing lead outside the interval.
  return share >= 0 && share < 1 ? FramePosition{before, share} : FramePosition{before, 0};
}

double frame_at_time(const Timeline& timeline, double seconds) {
  if (!has_own_times(timeline)) return without_rounding(seconds * nominal_frame_rate(timeline));
  const Array<double>& times = own_times(timeline);
  if (times.empty()) return 0;
  const double last = static_cast<double>(times.size() - 1);
  const bool is_before = seconds < times.front();
  const bool is_after = seconds > times.back();
  if (is_before || is_after) {
    const double step = median_step(times);
    const double beyond = seconds - (is_before ? times.front() : times.back());
    return (is_before ? 0 : last) + (step > 0 ? without_rounding(beyond / step) : 0);
  }
  const FramePosition position = position_in_time(times, seconds);
  return without_rounding(static_cast<double>(position.frame) + position.share);
}

double duration(const Timeline& timeline, std::size_t num_frames) {
  if (num_frames == 0) return 0;
  return time_of_frame(timeline, num_frames - 1) - time_of_frame(timeline, 0);
}

}  // namespace kinefile
