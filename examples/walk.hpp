// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "kinefile/motion.hpp"

namespace kinefile::examples {

/// A walk of any length and rate.
struct WalkOptions {
  std::size_t num_frames = 240;
  double frame_rate = 60;         ///< frames a second
  double steps_per_second = 1.8;  ///< of both feet together
  double metres_per_second = 1.3;
};

/// Makes a person's walk: 22 joints, centimetres, degrees, Y up, forwards along +Z, turning slowly
/// to the left. The same options give the same bits on every machine: values are rounded to six
/// decimals. It is made up of sines and meant to look like a walk, not to be a measured one.
Motion make_walk(const WalkOptions& options = {});

}  // namespace kinefile::examples
