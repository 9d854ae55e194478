// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "kinefile/math.hpp"

namespace kinefile {

/// An angle plus whole turns, so that it is within half a turn of another; unchanged, bit for bit,
/// if it already is.
/// \param turn  a whole turn in the unit of the angles
inline double nearest_turn(double angle, double near, double turn) {
  const double turns = (near - angle) / turn;
  return std::abs(turns) < 0.5 ? angle : angle + turn * std::round(turns);
}

/// As `nearest_turn`, for each of three angles.
inline Vec3 nearest_turns(const Vec3& angles, const Vec3& near, double turn) {
  return {nearest_turn(angles[0], near[0], turn), nearest_turn(angles[1], near[1], turn),
          nearest_turn(angles[2], near[2], turn)};
}

}  // namespace kinefile
