// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/robot_file.hpp"
#include "text/xml.hpp"

namespace kinefile::urdf {

/// Reads an XML text whose outermost element has this name; null after an error.
std::unique_ptr<text::xml::Tree> read_elements(const text::Source& source, const char* name,
                                               Diagnostics& diagnostics);

/// Reads the attributes of elements. Unexpected values are reported, and the result is empty.
struct Values {
  const text::Source& source;
  Diagnostics& diagnostics;
  bool is_of_shape = false;  ///< faults are warnings, since a robot moves without its shapes

  robot_file::Spot spot(const text::xml::Element& element) const { return {&source, element.at}; }
  robot_file::Spot spot(const text::xml::Attribute& attribute) const {
    return {&source, attribute.at()};
  }
  /// Reports a fault: an error with this code, or a shape that is left out.
  void report_fault(const robot_file::Spot& spot, const char* code, std::string message);
  void warn(const robot_file::Spot& spot, const char* code, std::string message) {
    spot.report(diagnostics, Severity::Warning, code, std::move(message));
  }

  /// The text of an attribute, which must exist.
  std::optional<std::string> word(const text::xml::Element& element, std::string_view name);
  /// A finite number.
  /// \param fallback  the value if there is no such attribute
  std::optional<double> number(const text::xml::Element& element, std::string_view name,
                               std::optional<double> fallback);
  /// A limit: a number or an infinity, which is no limit (urdfdom reads it so).
  std::optional<double> limit(const text::xml::Element& element, std::string_view name,
                              double fallback);
  /// Three finite numbers.
  std::optional<Vec3> vector(const text::xml::Element& element, std::string_view name,
                             const std::optional<Vec3>& fallback);
  /// Four finite numbers, not all 0, as x y z w.
  std::optional<Quat> quaternion(const text::xml::Element& element, std::string_view name);
};

/// The finite numbers in a text, separated by blanks; empty if there is something else in it.
std::vector<double> finite_numbers(std::string_view text);

/// An <origin>: where an element is in the frame that it belongs to.
struct Origin {
  Vec3 translation = Vec3::Zero();
  Quat rotation = Quat::Identity();
};

/// Reads an <origin>; empty after a fault.
/// \param knows_quaternions  the file is of URDF 1.1 or later
/// Source: urdfdom 5 (pose.cpp, URDF 1.1).
std::optional<Origin> read_origin(Values& values, const text::xml::Element& origin,
                                  bool knows_quaternions);

}  // namespace kinefile::urdf
