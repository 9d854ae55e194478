// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace kinefile::retime {

/// No map has more frames.
inline constexpr double kMostFrames = 134217728.0;  // 2^27

/// The whole number that a count of frames stands for, if it is one but for the rounding of the
/// arithmetic that it comes from; else the number itself.
inline double without_rounding(double frames) {
  const double whole = std::round(frames);
  const double slack = std::min(1e-9 * whole, 1e-3);
  return std::abs(frames - whole) <= slack ? whole : frames;
}

/// A frame, brought to the whole one that it misses by the last bits of its arithmetic alone: only
/// whole frames are shown bit for bit.
inline double on_whole_frame(double frame) {
  const double whole = std::round(frame);
  return std::abs(frame - whole) <= 1e-12 * std::max(1.0, whole) ? whole : frame;
}

}  // namespace kinefile::retime
