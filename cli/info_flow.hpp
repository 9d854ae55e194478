// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "json_output.hpp"
#include "kinefile/kinefile.hpp"

namespace kinefile::cli {

/// How a file is written, as its format describes it.
std::string dialect_text(const std::vector<Fact>& facts);

/// The common start of the information on every file: its name, format, kind and facts.
Json file_json(const std::string& path, const Info& info);

/// The content of a flow of poses, as text. Precondition: `info` is that of a flow.
std::string flow_text(const std::string& path, const Info& info);

/// The same as JSON; with its poses if `with_poses`.
Json flow_json(const std::string& path, const Info& info, bool with_poses);

/// One line per pose: number of its block, name, time, words of the enabled sliders; with a project
/// also their names and degrees.
std::string poses_text(const std::vector<PoseInfo>& poses);

}  // namespace kinefile::cli
