// SPDX-License-Identifier: MIT
#include "robot/robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "kinematics/joint_columns.hpp"
#include "math/turns.hpp"

namespace kinefile::robot {

double angle_about(const Quat& q, const Vec3& axis, double near) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const double angle = 2 * std::atan2(q.vec().dot(axis), q.w());
  return nearest_turn(angle, near, kTurn);
}

Quat rotation_of(const Component& links, std::span<const double> pose) {
  const auto q = quaternion_of_pose(links.pose_form, pose);
  return unit_quaternion({q[0], q[1], q[2], q[3]});
}

namespace {

/// Finds the displacements of one joint.
/// \param follows  the joint follows another, whose column is known: its angle is the nearest to
///                 that
void find_joint(const Component& links, std::size_t j, std::size_t column, bool follows,
                const Skeleton& skeleton, const Rows& rows, std::size_t num_frames) {
  const Joint& joint = skeleton.joints[j];
  const DegreeOfFreedom& dof = joint.dofs[0];
  const auto pose_of = [&](std::size_t frame, std::size_t link) {
    return links.row(frame).subspan(link * links.width(), links.width());
  };
  double near = 0;
  for (std::size_t f = 0; f < num_frames; ++f) {
    if (follows) near = value_in_row(dof, rows[f]);
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
    rows[f][column] = follows ? near : column_of(dof, near);
  }
}

}  // namespace

void find_joints(const Component& links, Motion& posed) {
  const auto columns = value_columns(posed.skeleton);
  const Rows rows = posed.clip.mutate();
  for (const bool follows : {false, true}) {  // first the joints that others follow
    for (std::size_t j = 1; j < posed.skeleton.joints.size(); ++j) {
      const auto& dofs = posed.skeleton.joints[j].dofs;
      if (dofs.empty() || (*columns[j] != dofs[0].coordinate) != follows) continue;
      find_joint(links, j, *columns[j], follows, posed.skeleton, rows, posed.clip.num_frames);
    }
  }
}

namespace {

/// The largest deviation of a recorded joint from the value that it has by following another.
struct Deviation {
  double largest = 0;
  std::size_t frame = 0;
};

/// The largest deviation that rounding to six digits does not explain; nothing if there is none.
std::optional<Deviation> deviation_of(const Motion& motion, const FollowingColumn& following) {
  constexpr double kRounding = 1e-6;
  const DegreeOfFreedom& dof = motion.skeleton.joints[following.joint].dofs[0];
  Deviation deviation;
  bool is_found = false;
  for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
    const double recorded = motion.clip.row(f)[following.column];
    const double own = value_of(dof, motion.clip.row(f)[dof.coordinate]);
    const double apart = std::abs(recorded - own);
    const double size = std::max({1.0, std::abs(recorded), std::abs(dof.gain)});
    if (!(apart > kRounding * size && apart > deviation.largest)) continue;
    deviation = {apart, f};
    is_found = true;
  }
  return is_found ? std::optional(deviation) : std::nullopt;
}

}  // namespace

Result<void> settle_following_columns(Motion& motion, bool lenient, Diagnostics& diagnostics) {
  const Skeleton& skeleton = motion.skeleton;
  bool any_differs = false;
  for (const FollowingColumn& following : following_columns(skeleton)) {
    const auto deviation = deviation_of(motion, following);
    if (!deviation) continue;
    const DegreeOfFreedom& dof = skeleton.joints[following.joint].dofs[0];
    const std::size_t leader = skeleton.coordinates[dof.coordinate].joint;
    Error error = make_error(
        ErrorKind::DataLoss, "BRG017",
        fmt::format("the joint of '{}' follows that of '{}' in the model, but moves by itself in "
                    "the motion: {:.3g} away at the most (frame {})",
                    skeleton.joints[following.joint].name, skeleton.joints[leader].name,
                    deviation->largest, deviation->frame));
    if (!lenient) {
      error.message += "; --lenient lets it follow";
      return fail(std::move(error));
    }
    error.severity = Severity::Warning;
    error.message += "; it follows";
    diagnostics.add(std::move(error));
    any_differs = true;
  }
  if (any_differs) fill_following_columns(motion, 0);
  return {};
}

}  // namespace kinefile::robot
