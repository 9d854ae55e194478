// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "json_output.hpp"
#include "kinefile/kinefile.hpp"

namespace kinefile::cli {

/// Adds what is known of a document's file, by key.
void add_facts(Json& json, const Document& document);

/// What a flow of poses holds, in words. Precondition: the document is one.
std::string flow_text(const std::string& path, const Document& document);

/// The same as JSON; with its poses, if they are asked for.
/// \param project  null: words are not degrees
Json flow_json(const std::string& path, const Document& document, bool with_poses,
               const RobotProject* project);

/// A line a pose: number of its block, name, time, words of the sliders that are enabled; with a
/// project their names and degrees.
std::string poses_text(const PoseFlow& flow, const RobotProject* project);

}  // namespace kinefile::cli
