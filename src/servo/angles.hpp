// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "kinefile/skeleton.hpp"

namespace kinefile::servo {

/// A column of a skeleton that holds an angle.
struct AngleColumn {
  std::size_t column = 0;
  double radians = 1;        ///< radians per unit of the angle
  DegreeOfFreedom dof = {};  ///< converts its number to an angle (see `value_of`)

  double angle_of(double number) const { return value_of(dof, number) * radians; }
  double number_of(double angle) const { return column_of(dof, angle / radians); }
};

/// Finds the angle that a name means: of a joint whose only degree of freedom is a rotation, or of
/// one of a joint's rotations, JOINT.CHANNEL.
/// \returns nothing if there is none
std::optional<AngleColumn> find_angle(const Skeleton& skeleton, const std::string& name);

}  // namespace kinefile::servo
