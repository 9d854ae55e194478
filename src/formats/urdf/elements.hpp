// SPDX-License-Identifier: MIT
#pragma once

#include <tinyxml2.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/robot_file.hpp"

namespace kinefile::urdf {

/// Reads the elements of an XML text. Unexpected content is reported, and the result is empty.
class Elements {
 public:
  /// \param source  UTF-8 without a byte order mark, must outlive this
  Elements(const text::Source& source, Diagnostics& diagnostics);

  /// The outermost element, which must have this name; null after an error.
  const tinyxml2::XMLElement* read_root(const char* name);

  /// The place of an element: its line is known, its column only if it is the first with its name
  /// in the line.
  robot_file::Spot spot(const tinyxml2::XMLElement& element) const;
  robot_file::Spot spot(const tinyxml2::XMLElement& element,
                        const tinyxml2::XMLAttribute& attribute) const;

  /// The text of an attribute, which must exist.
  std::optional<std::string> word(const tinyxml2::XMLElement& element, const char* attribute);
  /// A finite number.
  /// \param fallback  the value if there is no such attribute
  std::optional<double> number(const tinyxml2::XMLElement& element, const char* attribute,
                               double fallback);
  /// A limit: a number or an infinity, which is no limit (urdfdom reads it so).
  std::optional<double> limit(const tinyxml2::XMLElement& element, const char* attribute,
                              double fallback);
  /// Three finite numbers.
  std::optional<Vec3> vector(const tinyxml2::XMLElement& element, const char* attribute,
                             const Vec3& fallback);
  /// Four finite numbers, not all 0, as x y z w.
  std::optional<Quat> quaternion(const tinyxml2::XMLElement& element, const char* attribute);

  void report(Severity severity, const robot_file::Spot& spot, const char* code,
              std::string message) {
    spot.report(diagnostics_, severity, code, std::move(message));
  }
  Diagnostics& diagnostics() { return diagnostics_; }

 private:
  std::optional<double> read_number(const tinyxml2::XMLElement& element, const char* attribute,
                                    double fallback,
                                    std::optional<double> (*read)(std::string_view),
                                    std::string_view expected);
  std::vector<double> finite_numbers(const tinyxml2::XMLAttribute& attribute) const;
  const char* start_of_line(int line) const;
  robot_file::Spot find_in_line(int line, const std::string& word) const;
  void tell_fault();

  const text::Source& source_;
  Diagnostics& diagnostics_;
  tinyxml2::XMLDocument document_;
  std::vector<std::size_t> line_starts_;  ///< as tinyxml2 counts lines: only by line feeds
};

}  // namespace kinefile::urdf
