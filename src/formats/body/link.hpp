// SPDX-License-Identifier: MIT
#pragma once

#include "formats/body/values.hpp"

namespace kinefile::body {

/// Sets a link's joint id; ids below zero mean no id.
/// \param id  a whole number
void set_id(robot_file::Link& link, double id, const robot_file::Spot& spot);

/// Reads the `translation` of a link or an element; without one it is unchanged. False after an
/// error.
bool read_translation(Values& values, const text::yaml::Node& node, Vec3& translation);

/// Reads the `rotation` of a link or an element; without one it is unchanged. False after an error.
bool read_rotation(Values& values, const text::yaml::Node& node, Quat& rotation);

/// Reads a link's place and joint from a node; values that the node does not have are unchanged.
/// False after an error.
bool read_contents(Values& values, const text::yaml::Node& node, robot_file::Link& link);

}  // namespace kinefile::body
