// SPDX-License-Identifier: MIT
// Stands for the reader of projects until that is there: this file goes when it comes.

#include "kinefile/robot_project.hpp"

namespace kinefile {

std::vector<std::int16_t> base_values(const RobotProject& project) {
  if (project.base_pose >= project.base_poses.size()) {
    return std::vector<std::int16_t>(project.sliders.size());
  }
  std::vector<std::int16_t> values = project.base_poses[project.base_pose].values;
  values.resize(project.sliders.size());
  return values;
}

Result<RobotProject> read_project(std::string_view, const ReadOptions& options, Diagnostics&) {
  return fail(
      make_error(ErrorKind::Usage, "CLI001", "projects are not read yet", options.source_name));
}

}  // namespace kinefile
