// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace kinefile::retime {

/// The maximum number of frames of a map.
inline constexpr double kMostFrames = 134217728.0;  // 2^27

/// The whole number that a count of frames equals except for arithmetic rounding; otherwise the
/// number itself.
inline double without_rounding(double frames) {
  const double whole = std::round(frames);
  const double slack = std::min(1e-9 * whole, 1e-3);
  return std::abs(frames - whole) <= slack ? whole : frames;
}

/// A frame, rounded to a whole number if it differs from it by arithmetic rounding only: only whole
/// frames are shown bit for bit.
inline double on_whole_frame(double frame) {
  const double whole = std::round(frame);
  return std::abs(frame - whole) <= 1e-12 * std::max(1.0, whole) ? whole : frame;
}

}  // namespace kinefile::retime
