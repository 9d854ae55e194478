// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "command.hpp"

namespace kinefile::cli {

/// Reads the servo map that `--servo-map` names.
/// \errors IO001, and those of `parse_servo_map`
Result<ServoMap> load_servo_map(const std::string& path, Diagnostics& diagnostics);

/// The same map for a robot whose links are called otherwise than its joints: entries that name a
/// joint name its link.
ServoMap with_link_names(ServoMap map, const Document& robot);

/// What a robot did: displacements of the joints of a robot, or of the map's; or the motion of a
/// figure.
/// \param skeleton  a robot or a figure whose joints the map names; may be null
/// \errors SVM010
Result<Document> document_of_run(const flow::Run& run, const ServoMap& map,
                                 const Document* skeleton, Diagnostics& diagnostics);

}  // namespace kinefile::cli
