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
    const auto moved = std::find_if(joints.begin(), joints.end(), [&](const Joint& joint) {
      return !joint.joint_name.empty() && joint.joint_name == entry.joint;
    });
    if (moved != joints.end()) entry.joint = moved->name;
  }
  return map;
}

Result<Document> document_of_run(const flow::Run& run, const ServoMap& map,
                                 const Document* skeleton, Diagnostics& diagnostics) {
  Document document;
  const auto put = [&document](auto&& made) -> Result<Document> {
    if (!made) return fail(std::move(made.error()));
    document.content = std::move(*made);
    return std::move(document);
  };
  if (skeleton == nullptr) return put(servo::unroll(run, map, nullptr, diagnostics));
  const ServoMap own = with_link_names(map, *skeleton);
  const Skeleton& joints = skeleton_of(*skeleton);
  if (robot::is_robot(joints)) return put(servo::unroll(run, own, &joints, diagnostics));
  return put(servo::motion_of_run(run, own, joints, diagnostics));
}

}  // namespace kinefile::cli
