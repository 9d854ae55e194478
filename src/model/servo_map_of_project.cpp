// SPDX-License-Identifier: MIT
#include <algorithm>

#include "kinefile/servo_map.hpp"

namespace kinefile {
namespace {

constexpr int kStyleDegrees = 2;

bool is_joint(const RobotProject& project, std::size_t index) {
  const Slider& slider = project.sliders[index];
  if (slider.style != kStyleDegrees || !(slider.units_per_degree > 0)) return false;
  if (project.servos.empty()) return true;  // its file is missing
  return std::any_of(project.servos.begin(), project.servos.end(), [index](const Servo& servo) {
    return servo.slider == static_cast<int>(index);
  });
}

/// A unique name for an entry: the slider's own, or one with its number.
std::string joint_name(const ServoMap& map, const std::string& name, std::size_t slider) {
  const bool is_taken =
      std::any_of(map.entries.begin(), map.entries.end(),
                  [&](const ServoMapEntry& entry) { return entry.joint == name; });
  if (!name.empty() && !is_taken) return name;
  return (name.empty() ? "slider" : name) + "_" + std::to_string(slider);
}

}  // namespace

ServoMap servo_map_of(const RobotProject& project) {
  ServoMap map;
  map.num_sliders = project.sliders.size();
  map.tick_seconds = project.tick_seconds;
  map.base_pose = base_values(project);
  for (std::size_t i = 0; i < project.sliders.size(); ++i) {
    if (!is_joint(project, i)) continue;
    const Slider& slider = project.sliders[i];
    ServoMapEntry& entry = map.entries.emplace_back();
    entry.slider = i;
    entry.joint = joint_name(map, slider.name, i);
    entry.units_per_degree = slider.units_per_degree;
    entry.minimum = slider.minimum;
    entry.maximum = slider.maximum;
    entry.step = std::max(slider.step, 1);
  }
  return map;
}

}  // namespace kinefile
