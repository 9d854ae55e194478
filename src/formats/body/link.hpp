// SPDX-License-Identifier: MIT
#pragma once

#include "formats/body/values.hpp"

namespace kinefile::body {

/// Gives a link its joint id; ids below zero mean none.
/// \param id  a whole number
void set_id(robot_file::Link& link, double id, const robot_file::Spot& spot);

/// Reads what a node says of a link's place and joint; what it does not say stays as it is. False
/// after an error.
bool read_contents(Values& values, const text::yaml::Node& node, robot_file::Link& link);

}  // namespace kinefile::body
