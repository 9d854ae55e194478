// SPDX-License-Identifier: MIT
#pragma once

#include "formats/body/values.hpp"
#include "formats/robot_shapes.hpp"

namespace kinefile::body {

/// Reads the primitives that a link shows; null if there are none. Faults are warnings.
/// Source: Choreonoid's StdBodyLoader and StdSceneReader: what is not in a Collision is shown.
/// \param values  of the file that the link is in
robot_file::SharedShapes read_shapes(Values values, const text::yaml::Node& link,
                                     robot_file::ShapeCollector& collector);

}  // namespace kinefile::body
