// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "kinefile/motion.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// A joint that turns suddenly.
struct SuddenTurn {
  std::size_t joint = 0;
  std::size_t frame = 0;         ///< the first frame after the turn
  std::size_t return_frame = 0;  ///< the first frame after it turned back; 0 if it stays (a flip)
  double degrees = 0;            ///< how far it turns
};

/// Finds joints that turn from one frame to the next by too much and faster than 2700 degrees a
/// second, in their parents' frames: spikes, which turn back within five frames, or within two if
/// they are of 30 to 90 degrees, and flips, of more than 90 degrees, which stay. Sorted by joint,
/// then frame. Such turns come from markers that were confused during capture. The speed is that of
/// 90 degrees at 30 frames a second: nobody moves a joint back and forth so fast, but a throwing
/// arm reaches it one way. At 15 frames a second or less no turn is sudden, because none of up to
/// half a turn is that fast.
std::vector<SuddenTurn> find_sudden_turns(const Motion& motion);

}  // namespace kinefile

#pragma GCC visibility pop
