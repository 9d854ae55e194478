// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/diagnostics.hpp"
#include "kinefile/result.hpp"
#include "kinefile/robot_project.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// What one slider means to one joint: angle in degrees = sign * (word - offset) /
/// units_per_degree.
struct ServoMapEntry {
  std::size_t slider = 0;
  std::string joint;  ///< of a robot; of a figure a joint with one degree of freedom, or
                      ///< JOINT.CHANNEL as the header of a motion's CSV has it
  double sign = 1;    ///< 1 or -1
  double units_per_degree = 0;
  double offset = 0;                      ///< the word at which the joint's angle is 0
  int minimum = -32768, maximum = 32767;  ///< of the word
  int step = 1;                           ///< words are `minimum` plus a multiple of it
};

/// How the words of a flow and the joints of a robot belong together.
struct ServoMap {
  std::size_t num_sliders = 62;
  double tick_seconds = 1.0 / 60;
  std::vector<std::int16_t> base_pose;  ///< by slider; shorter: the rest are 0
  std::vector<ServoMapEntry> entries;   ///< in the order of the file
};

/// The angle of a word, in radians.
double angle_of_word(const ServoMapEntry& entry, double word);
/// The word of an angle in radians, neither rounded nor limited.
double word_of_angle(const ServoMapEntry& entry, double angle);

/// A map of a project: sliders in degrees that servos follow (all in degrees, where the project
/// does not tell servos), each to a joint of its own name.
ServoMap servo_map_of(const RobotProject& project);

/// Reads a map from YAML; docs/formats/servo-map.md tells how it looks.
/// \errors SVM001 and up with their places; those of YAML
Result<ServoMap> parse_servo_map(std::string_view text, const std::string& source_name,
                                 Diagnostics& diagnostics);

/// A map as YAML, which reads the same again; ticks are whole microseconds there.
std::string to_yaml(const ServoMap& map);

}  // namespace kinefile

#pragma GCC visibility pop
