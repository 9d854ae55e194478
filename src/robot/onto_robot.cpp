// SPDX-License-Identifier: MIT
// Transfers the motion of a figure to a robot with the same joint names: rotations relative to the
// rest poses, joint by joint; without balance and without inverse kinematics.

#include <fmt/format.h>

#include <algorithm>

#include "base/words.hpp"
#include "kinefile/joint_rotation.hpp"
#include "kinefile/robot.hpp"
#include "kinematics/joint_columns.hpp"
#include "model/joint_names.hpp"
#include "robot/robot.hpp"

namespace kinefile::robot {
namespace {

/// The largest residual rotation of a robot's joints without a warning, in degrees.
constexpr double kReportedDegrees = 1e-4;

/// A link of the robot that follows a joint of the figure, and the links that rotate it: those
/// after the nearest ancestor that also follows a joint.
struct Follower {
  std::size_t link = 0;
  std::size_t source = 0;
  std::size_t base = 0;               ///< the link that the path starts at
  std::vector<std::size_t> path;      ///< from after the base to the link itself
  std::vector<std::size_t> turning;   ///< the links of the path that turn: at most three
  Quat path_rest = Quat::Identity();  ///< the rotation of the path with angles 0 for turning links,
                                      ///< rest values for others
  std::vector<Vec3> axes;             ///< of the turning links, in the last one's frame at rest
  double largest_residual = 0;        ///< in radians
  std::size_t largest_frame = 0;
};

/// The figure's joint that each link follows; `kNoParent` for none.
std::vector<std::size_t> sources_of(const Skeleton& figure, const Skeleton& robot,
                                    const RobotNames& names) {
  std::vector<std::size_t> sources(robot.joints.size(), kNoParent);
  const JointNames figure_names(figure);
  for (std::size_t j = 0; j < sources.size(); ++j) {
    const std::string& link = robot.joints[j].name;
    const std::string& joint_name = robot.joints[j].joint_name;
    for (const std::string& name : {link, joint_name.empty() ? link : joint_name}) {
      const auto mapped = names.source_of.find(name);
      const std::vector<std::size_t>& found =
          figure_names.find(mapped == names.source_of.end() ? name : mapped->second);
      if (!found.empty() && sources[j] == kNoParent) sources[j] = found.front();
    }
  }
  if (sources[0] == kNoParent) sources[0] = 0;
  return sources;
}

bool turns(const Joint& joint) {
  return !joint.dofs.empty() && joint.dofs[0].kind == DofKind::Rotation;
}

/// Whether a third axis is perpendicular to two others, up to rounding.
bool is_across(const Vec3& a, const Vec3& b) { return std::abs(a.dot(b)) < 1e-6; }

/// \param leaders  of the robot's columns
Follower follower_of(std::size_t link, std::size_t source, const Skeleton& robot,
                     const std::vector<std::size_t>& leaders, std::vector<bool>& is_settled) {
  Follower follower{link, source, 0, {}, {}, Quat::Identity(), {}, 0, 0};
  std::size_t at = link;
  for (; at != 0 && !is_settled[at]; at = robot.joints[at].parent) follower.path.push_back(at);
  follower.base = at;
  std::reverse(follower.path.begin(), follower.path.end());
  for (const std::size_t j : follower.path) {
    is_settled[j] = true;
    const Quat& rest = robot.joints[j].rest_rotation;
    for (Vec3& axis : follower.axes) axis = rest.conjugate() * axis;
    // The other joint determines the angle of a joint that follows it.
    if (!turns(robot.joints[j]) || leaders[robot.joints[j].dofs[0].coordinate] != j) continue;
    follower.turning.push_back(j);
    follower.axes.push_back(robot.joints[j].dofs[0].axis);
  }
  // The last joints are used; more than three, or oblique ones, stay at rest.
  const auto drop_first = [&] {
    follower.turning.erase(follower.turning.begin());
    follower.axes.erase(follower.axes.begin());
  };
  while (follower.turning.size() > 3) drop_first();
  if (follower.turning.size() == 3 && !(is_across(follower.axes[0], follower.axes[1]) &&
                                        is_across(follower.axes[1], follower.axes[2]))) {
    drop_first();
  }
  if (follower.turning.size() == 2 && !is_across(follower.axes[0], follower.axes[1])) drop_first();
  for (const std::size_t j : follower.path) {
    const auto& turning = follower.turning;
    const bool is_free = std::find(turning.begin(), turning.end(), j) != turning.end();
    follower.path_rest = follower.path_rest * robot.joints[j].rest_rotation;
    if (is_free) continue;
    follower.path_rest = follower.path_rest * rotation_at_rest(robot.joints[j], robot.angle_unit);
  }
  return follower;
}

/// The angles of the turning links for a rotation, nearest to given angles.
std::vector<double> angles_of(const Follower& follower, const Quat& turn,
                              const std::vector<double>& near) {
  const auto& axes = follower.axes;
  if (axes.empty()) return {};
  if (axes.size() == 1) return {angle_about(turn, axes[0], near[0])};
  const bool has_three = axes.size() == 3;
  // Two links: as with a third axis perpendicular to both, whose rotation is the residual.
  const EulerAxes euler = {axes[0], axes[1], has_three ? axes[2] : Vec3(axes[0].cross(axes[1]))};
  const Vec3 angles =
      euler_angles(turn.toRotationMatrix(), euler, Vec3(near[0], near[1], has_three ? near[2] : 0));
  std::vector<double> found(angles.data(), angles.data() + axes.size());
  return found;
}

/// Computes the world rotations of the links of a path from their angles in a row.
void turn_path(const Follower& follower, const Skeleton& robot, std::span<const double> row,
               std::vector<Quat>& world) {
  for (const std::size_t j : follower.path) {
    const Joint& joint = robot.joints[j];
    world[j] = world[joint.parent] * joint.rest_rotation;
    if (!turns(joint)) continue;
    const double angle = value_in_row(joint.dofs[0], row);
    world[j] = world[j] * Quat(Eigen::AngleAxisd(angle, joint.dofs[0].axis));
  }
}

void report_residuals(const std::vector<Follower>& followers, const Motion& motion,
                      const Skeleton& robot, Diagnostics& diagnostics) {
  const std::vector<std::size_t> leaders = leaders_of_columns(robot);
  std::vector<std::string> still;
  std::vector<bool> is_used(robot.joints.size(), false);
  for (const Follower& follower : followers) {
    for (const std::size_t j : follower.turning) is_used[j] = true;
    const double degrees = follower.largest_residual / kRadiansPerDegree;
    if (degrees < kReportedDegrees) continue;
    diagnostics.add(
        Severity::Warning, "BRG015",
        fmt::format("link '{}' cannot turn as '{}' does: up to {:.3g} degrees are left "
                    "undone (frame {})",
                    robot.joints[follower.link].name, motion.skeleton.joints[follower.source].name,
                    degrees, follower.largest_frame));
  }
  for (std::size_t j = 1; j < robot.joints.size(); ++j) {
    const bool leads =
        !robot.joints[j].dofs.empty() && leaders[robot.joints[j].dofs[0].coordinate] == j;
    if (leads && !is_used[j]) still.push_back(robot.joints[j].name);
  }
  if (!still.empty()) {
    diagnostics.add(Severity::Warning, "BRG015",
                    fmt::format("joints that nothing moves stay at rest: {}", listed(still)));
  }
}

}  // namespace

Result<BodyMotion> onto_robot(const Motion& motion, const Skeleton& robot, const RobotNames& names,
                              Diagnostics& diagnostics) {
  if (!is_robot(robot)) {
    return fail(make_error(ErrorKind::Usage, "BRG012",
                           "expected the skeleton of a robot, whose root moves freely and whose "
                           "joints move in one way each"));
  }
  const std::vector<std::size_t> sources = sources_of(motion.skeleton, robot, names);
  const std::vector<std::size_t> leaders = leaders_of_columns(robot);
  std::vector<Follower> followers;
  std::vector<bool> is_settled(robot.joints.size(), false);
  for (std::size_t j = 1; j < robot.joints.size(); ++j) {
    if (sources[j] != kNoParent) {
      followers.push_back(follower_of(j, sources[j], robot, leaders, is_settled));
    }
  }
  if (followers.empty()) {
    return fail(make_error(ErrorKind::Usage, "BRG016",
                           "expected joints that are called like the robot's links or joints, "
                           "found none; --map FILE says which belong together"));
  }
  const WorldPoses rest =
      forward_kinematics(motion.skeleton, rest_clip(motion.skeleton), {.rotations = true});
  const Clip robot_rest = rest_clip(robot);
  const WorldPoses robot_poses = forward_kinematics(robot, robot_rest, {.rotations = true});
  const auto rotation_at = [](const PoseArrays& poses, std::size_t row, std::size_t joint) {
    const double* q = poses.rotations.data() + (row * poses.num_joints + joint) * 4;
    return Quat(q[0], q[1], q[2], q[3]);
  };
  const double scale = motion.skeleton.metres_per_unit > 0 ? motion.skeleton.metres_per_unit : 1.0;

  Motion moved{robot, robot_rest};
  moved.clip.values.clear();
  moved.clip.num_frames = motion.clip.num_frames;
  moved.clip.timeline = motion.clip.timeline;
  std::vector<double> row(robot_rest.values.begin(), robot_rest.values.end());
  std::vector<Quat> world(robot.joints.size(), Quat::Identity());
  Quat root_before = Quat::Identity();
  const std::size_t block = frames_per_block(motion.skeleton);
  for (std::size_t first = 0; first < motion.clip.num_frames; first += block) {
    const WorldPoses poses =
        forward_kinematics(motion.skeleton, motion.clip,
                           {.first_frame = first, .num_frames = block, .rotations = true});
    for (std::size_t r = 0; r < poses.num_frames; ++r) {
      // The world rotation of a link that has the same rotation relative to its rest pose as the
      // figure's joint.
      const auto wanted = [&](std::size_t link, std::size_t source) -> Quat {
        return rotation_at(poses, r, source) * rotation_at(rest, 0, source).conjugate() *
               rotation_at(robot_poses, 0, link);
      };
      const double* p = poses.positions.data() + (r * poses.num_joints + sources[0]) * 3;
      for (std::size_t k = 0; k < 3; ++k) row[k] = p[k] * scale;
      world[0] = root_before = on_side_of(wanted(0, sources[0]), root_before);
      const double q[] = {world[0].w(), world[0].x(), world[0].y(), world[0].z()};
      std::copy_n(q, 4, row.begin() + 3);
      for (Follower& follower : followers) {
        const Quat aim = wanted(follower.link, follower.source);
        const Quat turn = (world[follower.base] * follower.path_rest).conjugate() * aim;
        std::vector<double> near;
        for (const std::size_t j : follower.turning) {
          near.push_back(value_in_row(robot.joints[j].dofs[0], row));
        }
        const std::vector<double> angles = angles_of(follower, turn, near);
        for (std::size_t k = 0; k < angles.size(); ++k) {
          const DegreeOfFreedom& dof = robot.joints[follower.turning[k]].dofs[0];
          row[dof.coordinate] = column_of(dof, angles[k]);
        }
        turn_path(follower, robot, row, world);
      }
      for (Follower& follower : followers) {
        turn_path(follower, robot, row, world);  // including joints that follow others
        const double residual =
            angle_between(world[follower.link], wanted(follower.link, follower.source));
        if (residual > follower.largest_residual) {
          follower.largest_residual = residual;
          follower.largest_frame = first + r;
        }
      }
      moved.clip.values.append(row);
    }
  }
  report_residuals(followers, motion, robot, diagnostics);
  return project(moved, BodyForm::Joints, nullptr, diagnostics);
}

}  // namespace kinefile::robot
