// SPDX-License-Identifier: MIT
#include "kinefile/run.hpp"

namespace kinefile {

Result<ServoMap> read_servo_map(const std::string& path, Diagnostics& diagnostics) {
  const auto bytes = FileBytes::open(path);
  if (!bytes) return fail(bytes.error());
  return parse_servo_map(bytes->view(), path, diagnostics);
}

Result<ServoMap> make_servo_map(const std::string& path, Diagnostics& diagnostics) {
  const auto project = read_project_file(path, {}, diagnostics);
  if (!project) return fail(project.error());
  ServoMap map = servo_map_of(*project);
  if (!map.entries.empty()) return map;
  return fail(make_error(ErrorKind::InvalidInput, "SVM013",
                         "expected sliders that are shown in degrees and that servos follow, found "
                         "none",
                         path));
}

}  // namespace kinefile
