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

/// How a slider drives a joint: angle in degrees = sign * (word - offset) / units_per_degree.
struct ServoMapEntry {
  std::size_t slider = 0;
  std::string joint;  ///< a joint of a robot; for a figure a joint with one degree of freedom, or
                      ///< JOINT.CHANNEL as in the header of a motion's CSV
  double sign = 1;    ///< 1 or -1
  double units_per_degree = 0;
  double offset = 0;                      ///< the word at which the joint's angle is 0
  int minimum = -32768, maximum = 32767;  ///< limits of the word
  int step = 1;                           ///< words are `minimum` plus a multiple of it
};

/// How the words of a flow relate to the joints of a robot.
struct ServoMap {
  std::size_t num_sliders = 62;
  double tick_seconds = 1.0 / 60;
  std::vector<std::int16_t> base_pose;  ///< by slider; if shorter, the others are 0
  std::vector<ServoMapEntry> entries;   ///< in the order of the file
};

/// Converts a word to an angle in radians.
double angle_of_word(const ServoMapEntry& entry, double word);
/// Converts an angle in radians to a word, neither rounded nor limited.
double word_of_angle(const ServoMapEntry& entry, double angle);

/// Makes a map from a project: each slider that is shown in degrees and followed by a servo drives
/// a joint with the slider's name. If the project has no servos, all sliders in degrees do.
ServoMap servo_map_of(const RobotProject& project);

/// Reads a map from YAML; docs/formats/servo-map.md describes the format.
/// \errors SVM001 and up with their places; those of YAML
Result<ServoMap> parse_servo_map(std::string_view text, const std::string& source_name,
                                 Diagnostics& diagnostics);

/// Writes a map as YAML, which reads back as the same map; ticks are whole microseconds there.
std::string to_yaml(const ServoMap& map);

}  // namespace kinefile

#pragma GCC visibility pop
