// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "kinefile/array.hpp"
#include "kinefile/body_motion.hpp"
#include "kinefile/flow.hpp"
#include "kinefile/motion.hpp"
#include "kinefile/servo_map.hpp"

#pragma GCC visibility push(default)

namespace kinefile::servo {

/// Angles of joints over time, each joint by its name.
struct JointTrajectory {
  std::vector<std::string> joints;
  std::size_t num_frames = 0;
  double frame_time = 0;
  Array<double> angles;  ///< [frame][joint], in radians
};

/// What a robot did, as displacements of joints at every tick.
/// \param robot  joint ids are those of its joints; null: the map's entries in their order
/// \errors SVM010 (Usage) if no joint of the map is the robot's; others are told and left out
Result<BodyMotion> unroll(const flow::Run& run, const ServoMap& map, const Skeleton* robot,
                          Diagnostics& diagnostics);

/// The same, of a skeleton whose joints a map names, a robot's or a figure's; all else rests.
/// \errors SVM010 (Usage) if it has none of them
Result<Motion> motion_of_run(const flow::Run& run, const ServoMap& map, const Skeleton& skeleton,
                             Diagnostics& diagnostics);

/// The joints that a map names, out of a motion: by joint or JOINT.CHANNEL, whatever its angle
/// unit. Frames with times of their own are interpolated at the map's ticks.
/// \errors SVM010 (Usage) if it has none of them; those that are missing are told and left out,
///         so that their sliders stay disabled
Result<JointTrajectory> trajectory_of(const Motion& motion, const ServoMap& map,
                                      Diagnostics& diagnostics);

/// The joints that a map names, out of joint displacements: joint ids by the robot's joints;
/// without a robot joints by the names that the motion has of them, or else in the order of the
/// map's entries. As above otherwise.
/// \errors BRG010 (Usage) if there are no joint displacements; SVM010
Result<JointTrajectory> trajectory_of(const BodyMotion& motion, const ServoMap& map,
                                      const Skeleton* robot, Diagnostics& diagnostics);

/// How a trajectory becomes poses.
struct KeyframeOptions {
  std::optional<std::size_t> num_poses;  ///< at most so many, with the least largest error
  std::optional<double> tolerance;       ///< in degrees: as few poses as keep to it
  FlowFormat format = FlowFormat::V1R4;
  int lead_in_ticks = 60;  ///< the time of the first pose, in which the robot goes from where it
                           ///< stands to the first frame
};

/// How far a flow, as it runs, is from the trajectory that it was made of.
struct KeyframeError {
  std::string joint;
  double largest = 0;  ///< degrees
  double largest_seconds = 0;
  double rms = 0;
};

struct Keyframes {
  PoseFlow flow;
  std::vector<std::size_t> ticks;     ///< when each pose is reached
  std::vector<KeyframeError> errors;  ///< one a joint
};

/// Makes a flow of poses that follows a trajectory, from its first frame to its last. Times of
/// poses are whole ticks, 1 to 239 apart; dynamic programming over all of them finds those whose
/// lines between words, rounded and limited as the map says and as `flow::run` goes, keep closest
/// to the trajectory at every tick: with `num_poses` the least largest error, with `tolerance` the
/// fewest poses.
/// Of several best flows it is one with the fewest poses, and with the least largest error.
/// The last tick is the one at or after the time of the last frame, which it shows; between frames
/// the trajectory is a straight line. The word of a pose is that of the trajectory at its tick,
/// rounded to the map's steps and limited. With `num_poses`, what limits cut off does not count,
/// since no poses can give it. Sliders of no joint are disabled (0X0000).
/// \errors KEY001 (Usage) if neither or both are given, or neither can be; KEY002 (InvalidInput)
///         if words cannot come within the tolerance, with the joint and the time; KEY004
///         (InvalidInput) for angles that are no numbers; SVM010. Angles beyond the limits of a
///         joint's words are told (KEY003)
Result<Keyframes> keyframe(const JointTrajectory& trajectory, const ServoMap& map,
                           const KeyframeOptions& options, Diagnostics& diagnostics);

}  // namespace kinefile::servo

#pragma GCC visibility pop
