// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "formats/robot_file.hpp"

namespace kinefile::urdf {

/// Reads the robot of a URDF text. Empty after an error, which is in `diagnostics`.
/// \param source  UTF-8 without a byte order mark; the robot's places point into it
/// Sources: the pages of the ROS wiki on URDF's XML; how Choreonoid 2.5 reads it.
std::optional<robot_file::Robot> parse(const text::Source& source, Diagnostics& diagnostics);

}  // namespace kinefile::urdf
