// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/choreonoid/syntax.hpp"
#include "kinefile/body_motion.hpp"
#include "text/printer.hpp"

namespace kinefile::choreonoid {

/// The content of one component in a file.
struct PrintedComponent {
  const Component* component = nullptr;
  Array<double> converted;  ///< poses in another form than the component's; otherwise empty
  std::string type;
  std::string content;
  std::string pose_format;  ///< empty unless the component has poses
  PoseOrder pose_order = PoseOrder::QuaternionWFirst;
  double frame_rate = 0;  ///< 0: not written
  bool says_relative = false;
  std::string unknown_keys;  ///< YAML lines
};

/// The content of a file.
struct PrintedFile {
  int version = 2;
  std::string version_word;  ///< empty: not written
  bool is_snake_case = false;
  bool is_json = false;
  bool choreonoid_digits = false;
  std::string unknown_keys;
  std::vector<PrintedComponent> components;
};

/// Prints a .seq file: rows in flow style and everything else in blocks, or all as JSON.
void print_file(text::Printer& printer, const PrintedFile& file, std::string_view line_end);

}  // namespace kinefile::choreonoid
