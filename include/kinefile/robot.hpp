// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "kinefile/body_motion.hpp"
#include "kinefile/kinematics.hpp"
#include "kinefile/motion.hpp"
#include "kinefile/result.hpp"

#pragma GCC visibility push(default)

namespace kinefile::robot {

/// A component as a motion of separate parts. Each pose becomes a joint that moves freely (with
/// roll, pitch and yaw: three translations and three rotations), each vector a joint with
/// translations along x, y and z, each value a joint with a translation along x. Values stay the
/// same bit for bit. Joints are named link0, link1, ..., joint0, ..., or by the content.
Motion motion_of_component(const Component& component);

/// The name of a part of a component: its own, or "link0", "joint3", "ZMP.root", "Grip[0]" by the
/// content.
std::string name_of_part(const Component& component, std::size_t part);

/// A component with the frames, values and rate of the motion that `motion_of_component` made.
Component with_frames_of(const Component& component, const Motion& motion);

/// Whether a component holds places in the world: the poses of links, or a ZMP that is not relative
/// to the root link. What other components mean is not known, or it is no place: values of joints.
bool is_in_world(const Component& component);

/// Components side by side, as one motion of separate parts, at the times of the first. All have
/// one length.
Motion side_by_side(std::span<const Component* const> components);

/// Gives components the frames, values and rate of the motion that `side_by_side` made.
void put_side_by_side(const Motion& motion, std::span<Component* const> components);

/// The links of a body motion in the world, as recorded: no model is needed.
/// \errors BRG010 (Usage) if it has no link poses
Result<Motion> motion_of_links(const BodyMotion& motion);

/// Whether two components have one length and the same times.
bool agree(const Component& a, const Component& b);

/// The first component that does not `agree` with the main one; null if all do. Components of
/// unknown type are passed over.
const Component* find_disagreement(const BodyMotion& motion);

/// How the lengths and rates of two components differ: "3 frames at 50 a second of
/// 'JointDisplacement' beside 3 at 100 of 'LinkPosition'".
std::string words_of_disagreement(const Component& component, const Component& main);

/// All components side by side, as one motion of separate parts. Those of unknown type are left
/// out, with a diagnostic.
/// \param lenient  leaves those out, too, that do not `agree` with the main one
/// \errors BRG010 (Usage) if there are none; BRG021 (DataLoss) if they do not agree and `lenient`
/// is
///         false
Result<Motion> motion_of_components(const BodyMotion& motion, bool lenient,
                                    Diagnostics& diagnostics);

/// The same motion with three translations, along x, y and z, and three rotations, about z, y and
/// x, instead of each joint that moves freely. Angles are nearest to the previous frame.
Motion without_free_joints(const Motion& motion);

/// Applies a body motion to a robot: the first link's pose moves the root, joint displacements move
/// the joints, in order of their ids. Length and rate are those of the link poses, otherwise those
/// of the joint displacements. Without joint displacements, they are computed from link poses of
/// all links. Joints without values keep their rest values; values without a joint are dropped,
/// with a diagnostic. A joint that follows another (a mimic joint) follows it, regardless of its
/// recorded values.
/// \param skeleton  a robot's: a free root, columns in order of joint ids
/// \errors BRG010 (Usage) if there are neither link poses nor joint displacements;
/// BRG011 (InvalidInput) if there are fewer frames of joints than of links (`lenient` repeats the
/// last frame); BRG021 (DataLoss) if there are more, or at another rate (`lenient` goes by their
/// numbers); BRG012 (Usage) if the root of the skeleton is not free; BRG017 (DataLoss) if the
/// recorded value of a joint that follows another differs (`lenient` warns)
Result<Motion> pose(const BodyMotion& motion, const Skeleton& skeleton, bool lenient,
                    Diagnostics& diagnostics);

/// Replaces the link poses of kinematics by recorded ones, for the links that were recorded. The
/// first link is skipped because it moved the root already.
/// \param poses  the poses of the motion from `pose`
void put_recorded_links(const BodyMotion& motion, const Skeleton& skeleton, PoseArrays& poses);

/// How far kinematics and the recorded poses of a link differ.
struct LinkDeviation {
  std::string link;
  double distance = 0;  ///< the largest distance, in metres
  std::size_t distance_frame = 0;
  double degrees = 0;  ///< the largest angle between the rotations
  std::size_t degrees_frame = 0;
};

/// Compares kinematics with recorded links, one entry per recorded link.
/// \errors those of `pose`; BRG010 if no links were recorded
Result<std::vector<LinkDeviation>> compare_recorded_links(const BodyMotion& motion,
                                                          const Skeleton& skeleton, bool lenient,
                                                          Diagnostics& diagnostics);

/// The form of a body motion.
enum class BodyForm {
  Links,   ///< the poses of all links
  Joints,  ///< the pose of the root link and the displacements of all joints
  Both,
};

/// Makes a body motion from a motion. For a robot (a free root, joints with one degree of freedom),
/// values stay the same, and every joint id has one: a joint that follows another gets the
/// resulting value. The joints of any other motion become links. Lengths become metres, angles
/// radians.
/// \param other  a body motion whose other components (ZMP, ...) are copied; may be null
/// \errors BRG013 (Usage) if `form` wants joints and the motion is not a robot's
Result<BodyMotion> project(const Motion& motion, BodyForm form, const BodyMotion* other,
                           Diagnostics& diagnostics);

/// Which names of robot links and figure joints belong together.
struct RobotNames {
  std::map<std::string, std::string> source_of;  ///< maps a link or joint of the robot to the joint
                                                 ///< of the figure that it follows
};

/// Transfers a motion to a robot. Each link follows the joint with its name or its joint's name, or
/// the one given by `names`; the root follows the root. The figure is turned about z so that at
/// rest it faces as the robot does (see `find_facing`; a robot without sides faces +x), with a note
/// (BRG018). A link gets the same rotation relative to its rest pose as the joint; up to three
/// consecutive robot joints produce it. Only the root is translated, in metres. z is up in both.
/// Warnings report what the robot cannot do; feet may slide and float.
/// \param lenient  with less than all of the motion, too
/// \errors BRG012 (Usage) if `robot` is not a robot; BRG016 (Usage) if no names match; BRG019
///         (DataLoss) if more than 30 degrees of a joint's rotation are lost, and BRG020 (DataLoss)
///         if its legs do not hang down along z at rest, unless `lenient`
Result<BodyMotion> onto_robot(const Motion& motion, const Skeleton& robot, const RobotNames& names,
                              bool lenient, Diagnostics& diagnostics);

/// Whether a skeleton is a robot's as our readers make it: one root, which moves freely from the
/// world's origin and reads the first seven columns, and joints with at most one rotation or
/// translation, which read other columns.
bool is_robot(const Skeleton& skeleton);

/// Transforms the ZMP to the world frame, or to the root link's frame: z = R^-1 (p - root).
/// Choreonoid's own function computes R^-1 p - root.
/// \errors BRG010 (Usage) if there is no ZMP or no link pose
Result<BodyMotion> zmp(const BodyMotion& motion, bool is_root_relative, Diagnostics& diagnostics);

}  // namespace kinefile::robot

#pragma GCC visibility pop
