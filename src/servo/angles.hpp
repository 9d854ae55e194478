// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "kinefile/skeleton.hpp"

namespace kinefile::servo {

/// The column of a skeleton that holds an angle alone.
struct AngleColumn {
  std::size_t column = 0;
  double radians = 1;  ///< in one unit of it
};

/// Finds the angle that a name means: of a joint that turns about one axis and moves in no other
/// way, or of one of a joint's rotations, JOINT.CHANNEL. \return nothing if there is none
std::optional<AngleColumn> find_angle(const Skeleton& skeleton, const std::string& name);

}  // namespace kinefile::servo
