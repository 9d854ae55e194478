// SPDX-License-Identifier: MIT
#include "retime/interpolate_steps.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace kinefile::retime {
namespace {

/// Clamps a value of a map to the motion; NaN becomes the start.
double within(double old_frame, double last) {
  assert(!std::isnan(old_frame));
  return old_frame > 0 ? std::min(old_frame, last) : 0;
}

/// The number of old frames per new frame.
double rate_at(const std::vector<double>& old_frames, std::size_t frame, double last) {
  const std::size_t first = frame > 0 ? frame - 1 : 0;
  const std::size_t second = std::min(frame + 1, old_frames.size() - 1);
  if (first == second) return 0;
  const double passed = within(old_frames[second], last) - within(old_frames[first], last);
  return std::abs(passed) / static_cast<double>(second - first);
}

}  // namespace

std::vector<Step> steps_of(const std::vector<double>& old_frames, std::size_t num_old_frames,
                           bool antialias) {
  constexpr double kNoisyOne = 1 + 1e-9;  // the rate 1 of a map that is not exact
  const auto last = static_cast<double>(num_old_frames - 1);
  std::vector<Step> steps(old_frames.size());
  for (std::size_t n = 0; n < steps.size(); ++n) {
    const double place = within(old_frames[n], last);
    const double whole = std::floor(place);
    const double rate = antialias ? rate_at(old_frames, n, last) : 0;
    steps[n] = {n, static_cast<std::size_t>(whole), place - whole, rate > kNoisyOne ? rate / 2 : 0};
  }
  return steps;
}

Around around(const Step& step, std::size_t num_old_frames) {
  const std::size_t last = num_old_frames - 1;
  return {step.old_frame > 0 ? step.old_frame - 1 : 0, step.old_frame,
          std::min(step.old_frame + 1, last), std::min(step.old_frame + 2, last)};
}

std::vector<Tap> taps_of(const Step& step, std::size_t num_old_frames) {
  // If more frames than this are skipped, only some of them are used, so that the work for a new
  // frame is bounded.
  constexpr double kMostTapsAside = 256;
  const double centre = static_cast<double>(step.old_frame) + step.t;
  const double width = 3 * step.sigma;
  const auto stride = static_cast<std::size_t>(std::max(1.0, std::ceil(width / kMostTapsAside)));
  const auto middle = static_cast<std::size_t>(std::round(centre));
  const auto reach = static_cast<std::size_t>(width / static_cast<double>(stride));
  const std::size_t num_before = std::min(reach, middle / stride);
  const std::size_t num_after = std::min(reach, (num_old_frames - 1 - middle) / stride);
  std::vector<Tap> taps;
  double sum = 0;
  for (std::size_t i = 0; i <= num_before + num_after; ++i) {
    const std::size_t frame = middle - num_before * stride + i * stride;
    const double distance = (static_cast<double>(frame) - centre) / step.sigma;
    taps.push_back({frame, std::exp(-0.5 * distance * distance)});
    sum += taps.back().weight;
  }
  for (Tap& tap : taps) tap.weight /= sum;
  return taps;
}

}  // namespace kinefile::retime
