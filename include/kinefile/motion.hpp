// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/clip.hpp"
#include "kinefile/skeleton.hpp"

namespace kinefile {

/// A skeleton and how it moves. `clip.num_coordinates == skeleton.coordinates.size()`.
struct Motion {
  Skeleton skeleton;
  Clip clip;
};

}  // namespace kinefile
