// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "kinefile/body_motion.hpp"

namespace kinefile::choreonoid {

/// The order of a pose's numbers in the file.
enum class PoseOrder {
  QuaternionWFirst,  ///< XYZQWQXQYQZ
  QuaternionWLast,   ///< XYZQXQYQZQW
  RollPitchYaw,      ///< XYZRPY
};

/// The content of one component of a .seq file. Keys that it inherits from the top are included.
struct SeqComponent {
  const char* at = nullptr;
  std::string type;     ///< as spelled in the file
  std::string content;  ///< as spelled in the file
  ComponentKind kind = ComponentKind::Values;
  std::size_t num_parts = 1;
  std::optional<double> frame_rate;
  PoseOrder pose_order = PoseOrder::QuaternionWFirst;
  bool is_root_relative = false;
  bool has_times = false;
  std::size_t num_frames = 0;
  Array<double> values;                  ///< in the file's order
  std::vector<double> times;             ///< seconds, one per frame
  std::vector<const char*> time_places;  ///< the place of each
  std::string unknown_keys;              ///< as YAML lines
  std::string text;                      ///< the whole text of a component of unknown type
};

/// The content of a .seq file.
struct SeqFile {
  std::string version;  ///< as spelled in the file; empty if it is missing
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
