// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/clip.hpp"
#include "kinefile/skeleton.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// A skeleton and its values over time. `clip.num_coordinates == skeleton.coordinates.size()`.
struct Motion {
  Skeleton skeleton;
  Clip clip;
};

/// Checks what every other function relies on: the skeleton is valid, the clip has one column per
/// coordinate and as many values as rows and columns require, frames have finite times.
/// \errors MDL001 for the skeleton; MDL002 (InvalidInput) for the clip
Result<void> validate(const Motion& motion);

}  // namespace kinefile

#pragma GCC visibility pop
