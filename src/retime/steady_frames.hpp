// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "kinefile/result.hpp"

namespace kinefile::retime {

/// A map from frames at a steady rate to others: the new frame n is the old frame n x numerator /
/// denominator, the end included.
struct SteadyFrames {
  std::size_t num_old_frames = 0;  ///< at least one
  std::size_t num_frames = 0;
  double numerator = 1;
  double denominator = 1;

  double old_frame(std::size_t new_frame) const;
};

/// \errors RTM002 (Usage) for more than 2^27 new frames
Result<SteadyFrames> steady_frames(std::size_t num_old_frames, double numerator,
                                   double denominator);

}  // namespace kinefile::retime
