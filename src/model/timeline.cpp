// SPDX-License-Identifier: MIT
#include "kinefile/timeline.hpp"

#include <algorithm>
#include <cmath>

namespace kinefile {
namespace {

/// A positive number as it is written in decimals.
struct Decimals {
  double unit = 0;     ///< of the last decimal place; 0 where there are more than 15 digits
  int num_digits = 0;  ///< that count: without leading zeros
};

Decimals decimals_of(double value) {
  double scale = 1;  // a power of ten, exact up to 10^22
  for (int places = 0; places <= 22; ++places, scale *= 10) {
    const double digits = std::round(value * scale);
    if (digits >= 1e15) break;
    if (digits / scale != value) continue;
    return {1 / scale, static_cast<int>(std::floor(std::log10(digits))) + 1};
  }
  return {};
}

/// Whether a frame time is that of a rate, exactly or cut off or rounded to its last place.
bool stands_for(double time, const Decimals& decimals, double rate) {
  constexpr int kFewestDigits = 3;  // 0.03 may well be meant
  if (1 / rate == time) return true;
  const double lost = (1 / rate - time) / decimals.unit;
  return decimals.num_digits >= kFewestDigits && lost > -0.5001 && lost < 1;
}

}  // namespace

double frame_time(const Timeline& timeline) {
  return timeline.given == Timeline::Given::FrameTime ? timeline.value : 1 / timeline.value;
}

double frame_rate(const Timeline& timeline) {
  return timeline.given == Timeline::Given::FrameRate ? timeline.value : 1 / timeline.value;
}

double nominal_frame_rate(const Timeline& timeline) {
  const double time = timeline.value;
  const double rate = frame_rate(timeline);
  constexpr double kHighestRate = 1e9;
  const bool is_given = timeline.given == Timeline::Given::FrameRate;
  if (is_given || !(rate > 0 && rate < kHighestRate)) return rate;
  const Decimals decimals = decimals_of(time);
  const double whole = std::round(rate);
  if (whole >= 1 && stands_for(time, decimals, whole)) return whole;
  for (const double television : {24.0, 30.0, 60.0, 120.0}) {
    const double slowed = television * 1000 / 1001;
    if (stands_for(time, decimals, slowed)) return slowed;
  }
  return rate;
}

double time_of_frame(const Timeline& timeline, std::size_t frame) {
  if (frame < timeline.times.size()) return timeline.times[frame];
  const auto number = static_cast<double>(frame);
  // Dividing by a rate is exact where multiplying by its rounded inverse is not.
  const bool has_rate = timeline.given == Timeline::Given::FrameRate;
  return has_rate ? number / timeline.value : number * timeline.value;
}

double frame_of_time(const Timeline& timeline, double seconds) {
  const double frame = seconds * nominal_frame_rate(timeline);
  const double whole = std::round(frame);
  return std::abs(frame - whole) <= 1e-12 * std::max(1.0, std::abs(whole)) ? whole : frame;
}

double duration(const Timeline& timeline, std::size_t num_frames) {
  if (num_frames == 0) return 0;
  return time_of_frame(timeline, num_frames - 1) - time_of_frame(timeline, 0);
}

}  // namespace kinefile
