// SPDX-License-Identifier: MIT
#include "kinefile/servo_map.hpp"

#include "kinefile/math.hpp"

namespace kinefile {

double angle_of_word(const ServoMapEntry& entry, double word) {
  // Adding 0 turns -0 into 0, because -0 would confuse readers.
  return entry.sign * (word - entry.offset) / entry.units_per_degree * kRadiansPerDegree + 0.0;
}

double word_of_angle(const ServoMapEntry& entry, double angle) {
  return entry.offset + entry.sign * entry.units_per_degree * (angle / kRadiansPerDegree);
}

}  // namespace kinefile
