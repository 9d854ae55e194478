// SPDX-License-Identifier: MIT
#include "robot/robot.hpp"

#include <cmath>
#include <numbers>

#include "math/turns.hpp"

namespace kinefile::robot {

double angle_about(const Quat& q, const Vec3& axis, double near) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const double angle = 2 * std::atan2(q.vec().dot(axis), q.w());
  return nearest_turn(angle, near, kTurn);
}

Quat rotation_of(const Component& links, std::span<const double> pose) {
  const auto q = quaternion_of_pose(links.pose_form, pose);
  const Quat rotation(q[0], q[1], q[2], q[3]);
  return rotation.squaredNorm() > 0 ? rotation.normalized() : Quat::Identity();
}

void find_joints(const Component& links, Motion& posed) {
  const auto pose_of = [&](std::size_t frame, std::size_t link) {
    return links.row(frame).subspan(link * links.width(), links.width());
  };
  for (std::size_t j = 1; j < posed.skeleton.joints.size(); ++j) {
    const Joint& joint = posed.skeleton.joints[j];
    if (joint.dofs.empty()) continue;
    const DegreeOfFreedom& dof = joint.dofs[0];
    double near = 0;
    for (std::size_t f = 0; f < posed.clip.num_frames; ++f) {
      const auto parent = pose_of(f, joint.parent);
      const auto own = pose_of(f, j);
      const Quat world_from_parent = rotation_of(links, parent);
      const Quat rest_from_world = (world_from_parent * joint.rest_rotation).conjugate();
      if (dof.kind == DofKind::Rotation) {
        near = angle_about(rest_from_world * rotation_of(links, own), dof.axis, near);
      } else {
        const Vec3 way = Vec3(own[0], own[1], own[2]) - Vec3(parent[0], parent[1], parent[2]) -
                         world_from_parent * joint.offset;
        near = (rest_from_world * way).dot(dof.axis);
      }
      posed.clip.mutate()[f][dof.coordinate] = near;
    }
  }
}

}  // namespace kinefile::robot
