// SPDX-License-Identifier: MIT
#include "servo.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace kinefile::cli {

Result<ServoMap> load_servo_map(const std::string& path, Diagnostics& diagnostics) {
  const auto bytes = FileBytes::open(path);
  if (!bytes) return fail(bytes.error());
  return parse_servo_map(bytes->view(), path, diagnostics);
}

ServoMap with_link_names(ServoMap map, const Document& robot) {
  const std::vector<Joint>& joints = skeleton_of(robot).joints;
  for (ServoMapEntry& entry : map.entries) {
    const bool is_link = std::any_of(joints.begin(), joints.end(),
                                     [&](const Joint& joint) { return joint.name == entry.joint; });
    if (is_link) continue;
    for (const auto& [link, words] : robot.extras.joints) {
      const auto name = words.find("joint_name");
      if (name == words.end() || name->second != entry.joint) continue;
      entry.joint = link;
      break;
    }
  }
  return map;
}

Result<Document> document_of_run(const FlowRun& run, const ServoMap& map, const Document* skeleton,
                                 const Format& format, Diagnostics& diagnostics) {
  Document document;
  const auto put = [&document](auto&& made) -> Result<Document> {
    if (!made) return fail(std::move(made.error()));
    document.content = std::move(*made);
    return std::move(document);
  };
  const bool has_robot = skeleton != nullptr && is_robot(skeleton_of(*skeleton));
  const bool is_table = format.name == "csv";
  if (format.name == "choreonoid" || (has_robot && !is_table)) {
    const Skeleton* robot = has_robot ? &skeleton_of(*skeleton) : nullptr;
    const ServoMap own = has_robot ? with_link_names(map, *skeleton) : map;
    return put(unroll(run, own, robot, diagnostics));
  }
  if (skeleton != nullptr) {
    return put(
        motion_of_run(run, with_link_names(map, *skeleton), skeleton_of(*skeleton), diagnostics));
  }
  if (!is_table && format.name != "json") {
    return fail(make_error(ErrorKind::Usage, "CLI001",
                           fmt::format("a flow has no skeleton, which {} needs: --skeleton names "
                                       "one, or write .seq or .csv",
                                       format.name)));
  }
  return put(motion_of_run(run, map, loose_joints_of(map), diagnostics));
}

}  // namespace kinefile::cli
