// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "kinefile/body_motion.hpp"

namespace kinefile::choreonoid {

/// How the file orders the numbers of a pose.
enum class PoseOrder {
  QuaternionWFirst,  ///< XYZQWQXQYQZ
  QuaternionWLast,   ///< XYZQXQYQZQW
  RollPitchYaw,      ///< XYZRPY
};

/// What one component of a .seq file said. Keys that it inherits from the top are its own here.
struct SeqComponent {
  const char* at = nullptr;
  std::string type;     ///< as it is spelt
  std::string content;  ///< as it is spelt
  ComponentKind kind = ComponentKind::Values;
  std::size_t num_parts = 1;
  std::optional<double> frame_rate;
  PoseOrder pose_order = PoseOrder::QuaternionWFirst;
  bool is_root_relative = false;
  bool has_times = false;
  std::size_t num_frames = 0;
  Array<double> values;                  ///< in the file's order
  std::vector<double> times;             ///< seconds, one a frame
  std::vector<const char*> time_places;  ///< where each stands
  std::string unknown_keys;              ///< as YAML lines
  std::string text;                      ///< of a component of unknown type, all of it
};

/// What a .seq file said.
struct SeqFile {
  std::string version;  ///< as it is spelt; empty where it is not said
  int major = 1;
  bool is_snake_case = false;
  bool is_json = false;
  bool has_comments = false;
  std::optional<double> frame_rate;
  std::string unknown_keys;  ///< as YAML lines
  std::vector<SeqComponent> components;
};

/// The numbers of one part of a frame.
std::size_t width_of(const SeqComponent& component);

}  // namespace kinefile::choreonoid
