// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "kinefile/result.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// Which joint of a figure a robot's link or joint follows: maps its name to that of the figure's
/// joint.
using JointMap = std::map<std::string, std::string>;

/// Reads a map from YAML: `HEAD_P: Head`, one line per joint.
/// \errors MAP001 with its place if the text is not a mapping from names to names; those of YAML
Result<JointMap> parse_joint_map(std::string_view text, const std::string& source_name,
                                 Diagnostics& diagnostics);

}  // namespace kinefile

#pragma GCC visibility pop
