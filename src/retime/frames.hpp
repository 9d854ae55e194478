// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace kinefile::retiming {

/// No map has more frames.
inline constexpr double kMostFrames = 2147483648.0;  // 2^31

/// The whole number that a count of frames stands for, if it is one but for the rounding of the
/// arithmetic that it comes from; else the number itself.
inline double without_rounding(double frames) {
  const double whole = std::round(frames);
  const double slack = std::min(1e-9 * std::max(1.0, whole), 1e-3);
  return std::abs(frames - whole) <= slack ? whole : frames;
}

}  // namespace kinefile::retiming
