// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "kinefile/math.hpp"

namespace kinefile {

/// The whole turns to add to an angle so that it is within half a turn of another: the short way
/// round. 0 if it already is; a step of exactly half a turn stays as it is.
/// \param turn  a whole turn in the unit of the angles
inline double turns_towards(double angle, double near, double turn) {
  const double apart = near - angle;
  return std::abs(apart) <= 0.5 * turn ? 0 : turn * std::round(apart / turn);
}

/// An angle plus `turns_towards` another; unchanged, bit for bit, if it needs none.
inline double nearest_turn(double angle, double near, double turn) {
  const double turns = turns_towards(angle, near, turn);
  return turns == 0 ? angle : angle + turns;
}

/// As `nearest_turn`, for each of three angles.
inline Vec3 nearest_turns(const Vec3& angles, const Vec3& near, double turn) {
  return {nearest_turn(angles[0], near[0], turn), nearest_turn(angles[1], near[1], turn),
          nearest_turn(angles[2], near[2], turn)};
}

}  // namespace kinefile
