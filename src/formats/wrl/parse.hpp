// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "formats/robot_file.hpp"

namespace kinefile::wrl {

/// Reads the robot of a VRML text: its Humanoid and the Joints in it. Nothing after an error, which
/// is in `diagnostics`.
/// \param source  UTF-8 without a byte order mark; the robot's places point into it
/// Sources: ISO/IEC 14772-1 (VRML97); the prototypes of OpenHRP's models; what Choreonoid 2.5 makes
/// of them.
std::optional<robot_file::Robot> parse(const text::Source& source, Diagnostics& diagnostics);

}  // namespace kinefile::wrl
