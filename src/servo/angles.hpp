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
  double radians = 1;        ///< in one unit of the angle
  DegreeOfFreedom dof = {};  ///< what makes an angle of its number (see `value_of`)

  double angle_of(double number) const { return value_of(dof, number) * radians; }
  double number_of(double angle) const { return column_of(dof, angle / radians); }
};

/// Finds the angle that a name means: of a joint that turns about one axis and moves in no other
/// way, or of one of a joint's rotations, JOINT.CHANNEL. \return nothing if there is none
std::optional<AngleColumn> find_angle(const Skeleton& skeleton, const std::string& name);

}  // namespace kinefile::servo
