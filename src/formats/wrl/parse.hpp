// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "formats/robot_file.hpp"

namespace kinefile::wrl {

/// Reads the robot of a VRML text: its Humanoid and the Joints in it. Empty after an error, which
/// is in `diagnostics`.
/// \param source  UTF-8 without a byte order mark; the robot's places point into it
/// Sources: ISO/IEC 14772-1 (VRML97); the prototypes of OpenHRP's models; how Choreonoid 2.5 reads
/// them.
std::optional<robot_file::Robot> parse(const text::Source& source, Diagnostics& diagnostics);

}  // namespace kinefile::wrl
