// SPDX-License-Identifier: MIT
#include "support/robots.hpp"

namespace kinefile::test {

Skeleton hinge_robot() {
  Skeleton robot;
  robot.angle_unit = AngleUnit::Radians;
  robot.metres_per_unit = 1;
  Joint& base = robot.joints.emplace_back();
  base.name = "BASE";
  base.dofs.push_back({DofKind::Free, Vec3::UnitX(), 0, 0});
  for (const char* channel : {"x", "y", "z", "qw", "qx", "qy", "qz"}) {
    robot.coordinates.push_back({0, channel});
  }
  Joint& hinge = robot.joints.emplace_back();
  hinge.name = "HINGE";
  hinge.parent = 0;
  hinge.offset = {0.5, 0, 0};
  hinge.dofs.push_back({DofKind::Rotation, Vec3::UnitZ(), kRootColumns, 0, -1, 1, 2});
  robot.coordinates.push_back({1, "q"});
  return robot;
}

BodyMotion hinge_motion(const std::vector<double>& angles) {
  Component links;
  links.kind = ComponentKind::Poses;
  links.content = kLinkPosition;
  links.num_frames = angles.size();
  links.timeline = {FrameRate{10}, 0};
  Component joints = links;
  joints.kind = ComponentKind::Values;
  joints.content = kJointDisplacement;
  for (const double angle : angles) {
    for (const double value : {1.0, 2.0, 3.0, 1.0, 0.0, 0.0, 0.0}) links.values.push_back(value);
    joints.values.push_back(angle);
  }
  return {{links, joints}};
}

DocumentSource source_of(Document document) {
  return [given = std::make_shared<const Document>(std::move(document))](
             Diagnostics&) -> Result<std::shared_ptr<const Document>> { return given; };
}

DocumentSource source_that_fails() {
  return [](Diagnostics&) -> Result<std::shared_ptr<const Document>> {
    return fail(ErrorKind::Io, "IO001", "cannot read");
  };
}

}  // namespace kinefile::test
