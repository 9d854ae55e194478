// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/robot_file.hpp"
#include "text/yaml/tree.hpp"

namespace kinefile::body {

/// Reads the values of one file. Unexpected values are reported, and the result is empty.
struct Values {
  const text::Source& source;
  const text::yaml::Tree& tree;
  Diagnostics& diagnostics;
  bool has_degrees = true;   ///< false: its angles are radians
  bool is_of_shape = false;  ///< faults are warnings, since a robot moves without its shapes

  robot_file::Spot spot(const text::yaml::Node& node) const { return {&source, node.at}; }
  /// Reports a fault: an error with this code, or a shape that is left out.
  void error(const text::yaml::Node& node, const char* code, std::string message);

  /// A text; numbers are texts, too.
  std::optional<std::string> word(const text::yaml::Node& node, std::string_view what);
  /// A finite number.
  std::optional<double> number(const text::yaml::Node& node, std::string_view what);
  /// A limit of a joint: a number, or one of either sign that is infinite, which is no limit.
  std::optional<double> limit(const text::yaml::Node& node);
  /// A list of `count` finite numbers.
  std::optional<std::vector<double>> numbers(const text::yaml::Node& node, std::string_view what,
                                             std::size_t count);
  /// A list of `count` finite numbers, or a list of such lists, which may be lists of lists, too;
  /// all in the order of the file.
  std::optional<std::vector<std::vector<double>>> rows(const text::yaml::Node& node,
                                                       std::string_view what, std::size_t count);
  /// A list of finite numbers of any length.
  std::optional<std::vector<double>> list(const text::yaml::Node& node, std::string_view what);
  std::optional<Vec3> vector(const text::yaml::Node& node, std::string_view what);
  /// An angle of the file in radians.
  double radians(double angle) const { return has_degrees ? angle * kRadiansPerDegree : angle; }
};

/// The value of the first of some keys that a mapping has, or null.
const text::yaml::Node* find_any(const text::yaml::Node& node,
                                 std::initializer_list<std::string_view> keys);

}  // namespace kinefile::body
