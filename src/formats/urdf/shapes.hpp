// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

#include "formats/robot_shapes.hpp"
#include "formats/urdf/values.hpp"

namespace kinefile::urdf {

/// Reads the primitives in the <visual> elements of links.
class ShapeReader {
 public:
  /// \param robot  its materials are known to all links
  ShapeReader(const text::Source& source, Diagnostics& diagnostics, const text::xml::Element& robot,
              bool knows_quaternions);

  /// The shapes of a link; null if there are none.
  robot_file::SharedShapes read(const text::xml::Element& link);

 private:
  void read_visual(const text::xml::Element& visual, std::vector<VisualShape>& shapes);
  std::optional<Vec3> colour_of(const text::xml::Element& visual);
  void learn(const text::xml::Element& material);

  Values values_;
  robot_file::ShapeCollector collector_;
  bool knows_quaternions_;
  std::map<std::string, Vec3, std::less<>> colours_;  ///< of materials, by their names
};

}  // namespace kinefile::urdf
