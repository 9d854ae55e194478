// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/clip.hpp"
#include "kinefile/skeleton.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// A skeleton and how it moves. `clip.num_coordinates == skeleton.coordinates.size()`.
struct Motion {
  Skeleton skeleton;
  Clip clip;
};

/// Checks what every other function relies on: the skeleton is valid, the clip has a column for
/// each of its coordinates and as many values as it says, frames have finite times.
/// \errors MDL001 as for the skeleton; MDL002 (InvalidInput) for the clip
Result<void> validate(const Motion& motion);

}  // namespace kinefile

#pragma GCC visibility pop
