// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "kinefile/motion.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// A joint that goes where its robot, or its figure, cannot, or faster.
struct LimitBreach {
  enum class Kind { Below, Above, TooFast };
  Kind kind = Kind::Below;
  std::size_t joint = 0;
  std::size_t dof = 0;          ///< which of the joint's degrees of freedom
  std::size_t first_frame = 0;  ///< of TooFast: the later of the two frames
  std::size_t num_frames = 0;   ///< how many frames are beyond the limit
  double worst = 0;             ///< the value furthest beyond it, or the highest speed a second
  std::size_t worst_frame = 0;
  double limit = 0;
};

/// Finds the joints of a motion that leave the limits of their degrees of freedom: for each degree
/// of freedom and side one entry, in skeleton order. Values that are not finite are passed over.
std::vector<LimitBreach> find_limit_breaches(const Motion& motion);

}  // namespace kinefile

#pragma GCC visibility pop
