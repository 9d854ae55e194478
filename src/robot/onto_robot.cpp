// SPDX-License-Identifier: MIT
// Transfers the motion of a figure to a robot with the same joint names: rotations relative to the
// rest poses, joint by joint; without balance and without inverse kinematics.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "base/words.hpp"
#include "kinefile/evidence.hpp"
#include "kinefile/joint_rotation.hpp"
#include "kinefile/robot.hpp"
#include "kinematics/joint_columns.hpp"
#include "kinematics/limbs.hpp"
#include "kinematics/rotation_batches.hpp"
#include "model/joint_names.hpp"
#include "robot/robot.hpp"

namespace kinefile::robot {
namespace {

/// The largest residual rotation of a robot's joints without a warning, in degrees.
constexpr double kReportedDegrees = 1e-4;
/// The largest one with which the robot still does what the figure does.
constexpr double kMostDegrees = 30;

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
  Quat joint_from_link = Quat::Identity();  ///< the link relative to its joint, both at rest
  std::optional<RotationFitter> fitter = std::nullopt;  ///< finds the angles of the turning links
  double largest_residual = 0;                          ///< in radians
  std::size_t largest_frame = 0;
};

/// Some frames of the figure, and the world rotations of the robot's links in them.
struct Block {
  FrameBatch frames;
  WorldPoses figure;
  Quat heading;                          ///< turns the figure to face as the robot does
  std::vector<std::vector<Quat>> links;  ///< [link][frame of the block]
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
  Follower follower;
  follower.link = link;
  follower.source = source;
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

/// What finds the angles of a follower's turning links, each near the frame before; nothing where
/// no link turns.
/// \param rest  the robot's row at rest, which the first angles are near
std::optional<RotationFitter> fitter_of(const Follower& follower, const Skeleton& robot,
                                        std::span<const double> rest) {
  if (follower.turning.empty()) return std::nullopt;
  std::vector<DegreeOfFreedom> rotations;
  for (std::size_t k = 0; k < follower.turning.size(); ++k) {
    rotations.push_back(robot.joints[follower.turning[k]].dofs[0]);
    rotations.back().axis = follower.axes[k];
  }
  return RotationFitter(std::move(rotations), robot.angle_unit, rest);
}

Quat rotation_at(const PoseArrays& poses, std::size_t row, std::size_t joint) {
  const double* q = poses.rotations.data() + (row * poses.num_joints + joint) * 4;
  return Quat(q[0], q[1], q[2], q[3]);
}

/// The world rotation of a link that has the same rotation relative to its rest pose as the
/// figure's joint.
Quat aim_of(const Follower& follower, const Block& block, std::size_t frame) {
  return block.heading * rotation_at(block.figure, frame, follower.source) *
         follower.joint_from_link;
}

/// Moves the root as the figure's joint moves.
/// \param before  the root's rotation in the frame before; out: in the last frame
void move_root(const Follower& root, double length_scale, const Rows& rows, Block& block,
               Quat& before) {
  for (std::size_t f = 0; f < block.frames.count; ++f) {
    const std::span<double> row = rows[block.frames.first + f];
    const Vec3 place(&block.figure.positions[(f * block.figure.num_joints + root.source) * 3]);
    const Vec3 turned = block.heading * place * length_scale;
    std::copy(turned.begin(), turned.end(), row.begin());
    before = on_side_of(aim_of(root, block, f), before);
    block.links[0][f] = before;
    const double q[] = {before.w(), before.x(), before.y(), before.z()};
    std::copy_n(q, 4, row.begin() + 3);
  }
}

/// Computes the world rotations of the links of a path from their angles.
void turn_path(const Follower& follower, const Skeleton& robot, const Rows& rows, Block& block) {
  for (const std::size_t j : follower.path) {
    const Joint& joint = robot.joints[j];
    for (std::size_t f = 0; f < block.frames.count; ++f) {
      Quat& link = block.links[j][f];
      link = block.links[joint.parent][f] * joint.rest_rotation;
      if (!turns(joint)) continue;
      const double angle = value_in_row(joint.dofs[0], rows[block.frames.first + f]);
      link = link * Quat(Eigen::AngleAxisd(angle, joint.dofs[0].axis));
    }
  }
}

/// Finds the angles of a follower's turning links in all frames of a block.
void fit_path(Follower& follower, const Rows& rows, const Block& block,
              simd::Quaternions& rotations) {
  if (!follower.fitter) return;
  rotation::resize(rotations, block.frames.count);
  for (std::size_t f = 0; f < block.frames.count; ++f) {
    const Quat base = block.links[follower.base][f] * follower.path_rest;
    rotation::put_quaternion(base.conjugate() * aim_of(follower, block, f), f, rotations);
  }
  follower.fitter->fit(rotations, block.frames, rows);
}

/// Keeps the largest angle between a link and where it should point.
void measure_residual(Follower& follower, const Block& block) {
  for (std::size_t f = 0; f < block.frames.count; ++f) {
    const double residual =
        angle_between(block.links[follower.link][f], aim_of(follower, block, f));
    if (residual <= follower.largest_residual) continue;
    follower.largest_residual = residual;
    follower.largest_frame = block.frames.first + f;
  }
}

/// The angle between two directions on the ground, counter-clockwise from above, in degrees. At
/// rest, figures face along an axis but for their own asymmetry, which is left out.
double degrees_between(const Vec3& from, const Vec3& to) {
  constexpr double kAsymmetry = 20;
  const double degrees =
      std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to)) / kRadiansPerDegree;
  const double quarters = 90 * std::round(degrees / 90);
  return std::abs(degrees - quarters) < kAsymmetry ? quarters : degrees;
}

/// The rotation about z that turns the figure at rest to face as the robot does at rest.
Quat heading_of(const Skeleton& figure, const Skeleton& robot, Diagnostics& diagnostics) {
  constexpr std::size_t kZ = 2;
  const Facing from = find_facing({figure, {}}, kZ);
  if (!from.direction) return Quat::Identity();
  const Vec3 to = find_facing({robot, {}}, kZ).direction.value_or(Vec3::UnitX());
  const double degrees = degrees_between(*from.direction, to);
  if (degrees == 0) return Quat::Identity();
  diagnostics.add(Severity::Note, "BRG018",
                  fmt::format("the figure is turned by {:.4g} degrees about z, so that it faces as "
                              "the robot does",
                              degrees));
  return Quat(Eigen::AngleAxisd(degrees * kRadiansPerDegree, Vec3::UnitZ()));
}

/// Refuses a motion of which a robot cannot do a large part.
Result<void> expect_reachable(const std::vector<Follower>& followers, const Skeleton& figure,
                              const Skeleton& robot) {
  std::vector<std::string> lost;
  double most = 0;
  for (const Follower& follower : followers) {
    const double degrees = follower.largest_residual / kRadiansPerDegree;
    most = std::max(most, degrees);
    if (degrees <= kMostDegrees) continue;
    lost.push_back(fmt::format("{} ({})", robot.joints[follower.link].name,
                               figure.joints[follower.source].name));
  }
  if (lost.empty()) return {};
  return fail(ErrorKind::DataLoss, "BRG019",
              fmt::format("the robot cannot do what the figure does: up to {:.3g} degrees would be "
                          "lost in {}; --lenient goes on",
                          most, listed(lost)));
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

/// The root, then the other links that follow a joint of the figure.
std::vector<Follower> followers_of(const Skeleton& figure, const Skeleton& robot,
                                   const RobotNames& names, const Quat& heading) {
  const std::vector<std::size_t> sources = sources_of(figure, robot, names);
  const std::vector<std::size_t> leaders = leaders_of_columns(robot);
  const Clip rest = rest_clip(robot);
  const WorldPoses figure_poses =
      forward_kinematics(figure, rest_clip(figure), {.rotations = true});
  const WorldPoses robot_poses = forward_kinematics(robot, rest, {.rotations = true});
  std::vector<Follower> followers;
  std::vector<bool> is_settled(robot.joints.size(), false);
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    if (sources[j] == kNoParent) continue;
    Follower& follower =
        followers.emplace_back(follower_of(j, sources[j], robot, leaders, is_settled));
    follower.joint_from_link = (heading * rotation_at(figure_poses, 0, sources[j])).conjugate() *
                               rotation_at(robot_poses, 0, j);
    follower.fitter = fitter_of(follower, robot, rest.row(0));
  }
  return followers;
}

}  // namespace

Result<BodyMotion> onto_robot(const Motion& motion, const Skeleton& robot, const RobotNames& names,
                              bool lenient, Diagnostics& diagnostics) {
  if (!is_robot(robot)) {
    return fail(make_error(ErrorKind::Usage, "BRG012",
                           "expected the skeleton of a robot, whose root moves freely and whose "
                           "joints move in one way each"));
  }
  if (!lenient && !stands_at_rest(motion.skeleton, 2).value_or(true)) {
    return fail(ErrorKind::DataLoss, "BRG020",
                "the figure does not stand at rest, from where its rotations count, so the robot "
                "would not stand either; --lenient goes on");
  }
  const Quat heading = heading_of(motion.skeleton, robot, diagnostics);
  std::vector<Follower> followers = followers_of(motion.skeleton, robot, names, heading);
  if (followers.size() < 2) {
    return fail(make_error(ErrorKind::Usage, "BRG016",
                           "expected joints that are called like the robot's links or joints, "
                           "found none; --map FILE says which belong together"));
  }
  const double scale = motion.skeleton.metres_per_unit > 0 ? motion.skeleton.metres_per_unit : 1.0;
  const Clip rest = rest_clip(robot);
  Motion moved{robot, rest};
  moved.clip.num_frames = motion.clip.num_frames;
  moved.clip.timeline = motion.clip.timeline;
  moved.clip.values.clear();
  for (std::size_t f = 0; f < motion.clip.num_frames; ++f) moved.clip.values.append(rest.row(0));
  const Rows rows = moved.clip.mutate();
  Quat root = Quat::Identity();
  simd::Quaternions rotations;
  for (const FrameBatch& frames : batches_of(motion.clip.num_frames)) {
    Block block{
        frames,
        forward_kinematics(
            motion.skeleton, motion.clip,
            {.first_frame = frames.first, .num_frames = frames.count, .rotations = true}),
        heading,
        std::vector(robot.joints.size(), std::vector<Quat>(frames.count, Quat::Identity()))};
    move_root(followers.front(), scale, rows, block, root);
    for (Follower& follower : std::span(followers).subspan(1)) {
      fit_path(follower, rows, block, rotations);
      turn_path(follower, robot, rows, block);
    }
    // Once more, with the joints that follow others.
    for (Follower& follower : std::span(followers).subspan(1)) {
      turn_path(follower, robot, rows, block);
      measure_residual(follower, block);
    }
  }
  report_residuals(followers, motion, robot, diagnostics);
  if (!lenient) {
    if (auto done = expect_reachable(followers, motion.skeleton, robot); !done) {
      return fail(std::move(done.error()));
    }
  }
  return project(moved, BodyForm::Joints, nullptr, diagnostics);
}

}  // namespace kinefile::robot
