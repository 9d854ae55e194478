// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "kinefile/body_motion.hpp"
#include "kinefile/kinematics.hpp"
#include "kinefile/motion.hpp"
#include "kinefile/result.hpp"

#pragma GCC visibility push(default)

namespace kinefile::robot {

/// A component as a motion of loose parts: every pose a joint that moves freely (roll, pitch and
/// yaw three translations and three rotations), every vector one that moves along x, y and z, every
/// value one along x. Values stay as they are, bit for bit. Joints are called link0, link1, ...,
/// joint0, ..., or by the content.
Motion motion_of_component(const Component& component);

/// A component with the frames, values and rate of the motion that `motion_of_component` made.
Component with_frames_of(const Component& component, const Motion& motion);

/// The links of a body motion in the world, as they were recorded: no model is needed.
/// \errors BRG010 (Usage) if it has no link poses
Result<Motion> motion_of_links(const BodyMotion& motion);

/// All components side by side, as one motion of loose parts: those that have as many frames as the
/// main one (links, else joints, else the first); others are told and left out.
Motion motion_of_components(const BodyMotion& motion, Diagnostics& diagnostics);

/// The same motion with three translations, along x, y and z, and three rotations, about z, y and
/// x, in the place of each joint that moves freely. Angles go on from the frame before.
Motion without_free_joints(const Motion& motion);

/// Puts a body motion on a robot: the first link's pose moves the root, joint displacements move
/// the joints, in order of their ids. Length and rate are those of the link poses, else those of
/// the joint displacements. Without joint displacements, link poses of all links give them. What is
/// missing rests; what is too much is told and left out. A joint that follows another (a mimic
/// joint) follows it, whatever is recorded of it.
/// \param skeleton  of a robot: a free root, columns in order of joint ids
/// \errors BRG010 (Usage) if there are neither link poses nor joint displacements;
///         BRG011 (InvalidInput) if there are fewer frames of joints than of links and not
///         `lenient`, which holds the last; BRG012 (Usage) if the root of the skeleton is not
///         free; BRG017 (DataLoss) if a joint that follows another was recorded elsewhere and not
///         `lenient`, which warns
Result<Motion> pose(const BodyMotion& motion, const Skeleton& skeleton, bool lenient,
                    Diagnostics& diagnostics);

/// Puts recorded poses of links in the place of those that kinematics found, as far as links were
/// recorded; the first one moved the root already.
/// \param poses  of the motion that `pose` made
void put_recorded_links(const BodyMotion& motion, const Skeleton& skeleton, PoseArrays& poses);

/// How far kinematics and the recorded poses of a link differ.
struct LinkDeviation {
  std::string link;
  double distance = 0;  ///< metres, the largest
  std::size_t distance_frame = 0;
  double degrees = 0;  ///< the largest angle between rotations
  std::size_t degrees_frame = 0;
};

/// Compares kinematics with recorded links, one entry a link that was recorded.
/// \errors those of `pose`; BRG010 if no links were recorded
Result<std::vector<LinkDeviation>> compare_recorded_links(const BodyMotion& motion,
                                                          const Skeleton& skeleton, bool lenient,
                                                          Diagnostics& diagnostics);

/// Which of the three usual forms of a body motion is wanted.
enum class BodyForm {
  Links,   ///< the poses of all links
  Joints,  ///< the pose of the root link and the displacements of all joints
  Both,
};

/// Makes a body motion of a motion. Of a robot (a free root, joints of one degree of freedom),
/// values stay as they are, and every joint id has one: that of a joint which follows another is
/// what it has by that; any other motion's joints become links. Lengths become metres, angles
/// radians.
/// \param other  a body motion whose further components (ZMP, ...) go along; may be null
/// \errors BRG013 (Usage) if `form` wants joints and the motion is not a robot's
Result<BodyMotion> project(const Motion& motion, BodyForm form, const BodyMotion* other,
                           Diagnostics& diagnostics);

/// What joints of figures and links of robots are called, so that they can be matched.
struct RobotNames {
  std::map<std::string, std::string> source_of;  ///< a link or joint of the robot to the joint of
                                                 ///< the figure that it follows
};

/// Puts a motion on a robot: each link follows the joint of its name, of its joint's name, or that
/// `names` says; the root follows the root. A link turns from its rest pose as the joint does from
/// its own; up to three joints in a row bring that about. Positions are the root's, in metres. z is
/// up in both. What cannot be done is told in warnings; feet may slide and float.
/// \errors BRG012 (Usage) if `robot` is none; BRG016 (Usage) if no names match
Result<BodyMotion> onto_robot(const Motion& motion, const Skeleton& robot, const RobotNames& names,
                              Diagnostics& diagnostics);

/// Whether a skeleton is a robot's as our readers make it: one root, which moves freely from the
/// world's origin and reads the first seven columns, and joints that turn or translate in one way
/// at most, by other columns.
bool is_robot(const Skeleton& skeleton);

/// Brings ZMP into the world's frame, or into the root link's: z = R^-1 (p - root). Choreonoid's
/// own function computes R^-1 p - root.
/// \errors BRG010 (Usage) if there is no ZMP or no link pose
Result<BodyMotion> zmp(const BodyMotion& motion, bool is_root_relative, Diagnostics& diagnostics);

}  // namespace kinefile::robot

#pragma GCC visibility pop
