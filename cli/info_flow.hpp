// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "json_output.hpp"
#include "kinefile/kinefile.hpp"

namespace kinefile::cli {

/// What a flow of poses holds, in words.
/// \param flow  what `info` tells of the document
std::string flow_text(const std::string& path, const Document& document, const FlowInfo& flow);

/// The same as JSON; with its poses, if they are asked for.
Json flow_json(const std::string& path, const Document& document, const FlowInfo& flow,
               bool with_poses);

/// A line a pose: number of its block, name, time, words of the sliders that are enabled; with a
/// project their names and degrees.
std::string poses_text(const std::vector<PoseInfo>& poses);

}  // namespace kinefile::cli
