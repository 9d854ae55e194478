// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "json_output.hpp"
#include "kinefile/kinefile.hpp"

namespace kinefile::cli {

/// How a file is written, in the words of its format.
std::string dialect_text(const std::vector<Fact>& facts);

/// The start of what is told of every file: its name, format, kind and facts.
Json file_json(const std::string& path, const Info& info);

/// What a flow of poses holds, in words. Precondition: it is told of one.
std::string flow_text(const std::string& path, const Info& info);

/// The same as JSON; with its poses, if they are asked for.
Json flow_json(const std::string& path, const Info& info, bool with_poses);

/// A line a pose: number of its block, name, time, words of the sliders that are enabled; with a
/// project their names and degrees.
std::string poses_text(const std::vector<PoseInfo>& poses);

}  // namespace kinefile::cli
