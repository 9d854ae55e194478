// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "kinefile/timeline.hpp"

namespace kinefile {

/// The frames between which a rate of change at a frame is measured.
struct Neighbours {
  std::size_t before = 0;
  std::size_t after = 0;
  double seconds = 0;  ///< from `before` to `after`; 0 for a single frame
};

/// The neighbours of a frame, for a central difference; at an end of the motion the frame itself
/// takes the place of the missing one.
/// \param num_frames  of the motion; above `frame`
inline Neighbours neighbours_of(const Timeline& timeline, std::size_t frame,
                                std::size_t num_frames) {
  const std::size_t before = frame > 0 ? frame - 1 : frame;
  const std::size_t after = std::min(frame + 1, num_frames - 1);
  return {before, after, time_of_frame(timeline, after) - time_of_frame(timeline, before)};
}

/// A change per second; not finite if no time passes or it runs backwards.
inline double per_second(double change, double seconds) {
  return seconds > 0 ? change / seconds : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace kinefile
