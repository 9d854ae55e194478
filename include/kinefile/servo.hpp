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

/// Angles of named joints over time.
struct JointTrajectory {
  std::vector<std::string> joints;
  std::size_t num_frames = 0;
  double frame_time = 0;
  Array<double> angles;  ///< [frame][joint], in radians
};

/// A run as joint displacements at every tick.
/// \param robot  gives the joint ids; null: the map's entries in their order
/// \errors SVM010 (Usage) if the robot has no joint of the map; missing single joints are omitted,
///         with a diagnostic
Result<BodyMotion> unroll(const flow::Run& run, const ServoMap& map, const Skeleton* robot,
                          Diagnostics& diagnostics);

/// A run as a motion of a skeleton whose joints the map names, a robot's or a figure's. All other
/// joints keep their rest values.
/// \errors SVM010 (Usage) if it has none of them
Result<Motion> motion_of_run(const flow::Run& run, const ServoMap& map, const Skeleton& skeleton,
                             Diagnostics& diagnostics);

/// The joints that a map names, from a motion in any angle unit: by joint or JOINT.CHANNEL. Frames
/// with their own times are interpolated at the map's ticks.
/// \errors SVM010 (Usage) if it has none of them; missing single joints are omitted, with a
///         diagnostic, and their sliders stay disabled
Result<JointTrajectory> trajectory_of(const Motion& motion, const ServoMap& map,
                                      Diagnostics& diagnostics);

/// The joints that a map names, from joint displacements. The robot gives the joint ids; without a
/// robot, joints are matched by the names in the motion, otherwise by the order of the map's
/// entries. Apart from that as above.
/// \errors BRG010 (Usage) if there are no joint displacements; SVM010
Result<JointTrajectory> trajectory_of(const BodyMotion& motion, const ServoMap& map,
                                      const Skeleton* robot, Diagnostics& diagnostics);

/// How a trajectory is approximated by poses.
struct KeyframeOptions {
  std::optional<std::size_t> num_poses;  ///< at most this many, with the smallest maximum error
  std::optional<double> tolerance;       ///< in degrees: the fewest poses within it
  FlowFormat format = FlowFormat::V1R4;
  int lead_in_ticks = 60;  ///< the time of the first pose, in which the robot moves from its
                           ///< current pose to the first frame
};

/// How far a running flow deviates from its trajectory.
struct KeyframeError {
  std::string joint;
  double largest = 0;  ///< degrees
  double largest_seconds = 0;
  double rms = 0;
};

struct Keyframes {
  PoseFlow flow;
  std::vector<std::size_t> ticks;     ///< when each pose is reached
  std::vector<KeyframeError> errors;  ///< one per joint
};

/// Makes a flow of poses that approximates a trajectory, from its first frame to its last. Times of
/// poses are whole ticks, 1 to 239 apart. Dynamic programming over all of them finds the best
/// poses; the error is that of the interpolated words at every tick, rounded and limited by the map
/// and interpolated as by `flow::run`. With `num_poses` the maximum error is minimised, with
/// `tolerance` the number of poses. Of several best flows, the result has the fewest poses and the
/// smallest maximum error.
/// The last tick is the one at or after the time of the last frame, which it shows; between frames
/// the trajectory is linear. The word of a pose is that of the trajectory at its tick, rounded to
/// the map's steps and limited. With `num_poses`, errors caused by limits are not counted, because
/// no poses can avoid them. Sliders without a joint are disabled (0X0000).
/// \errors KEY001 (Usage) if not exactly one of `num_poses` and `tolerance` is given, or it is not
///         valid; KEY002 (InvalidInput) if words cannot meet the tolerance, with the joint and the
///         time; KEY004 (InvalidInput) for angles that are not finite; SVM010. KEY003 reports
///         angles beyond the limits of a joint's words
Result<Keyframes> keyframe(const JointTrajectory& trajectory, const ServoMap& map,
                           const KeyframeOptions& options, Diagnostics& diagnostics);

}  // namespace kinefile::servo

#pragma GCC visibility pop
