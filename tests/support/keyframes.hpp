// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "kinefile/servo.hpp"

namespace kinefile::test {

/// A map of joints j0, j1, ... on sliders 0, 1, ..., 100 words a degree.
ServoMap map_of_joints(std::size_t num_joints, int step = 1);

/// A trajectory of one joint, j0, a frame a tick.
servo::JointTrajectory trajectory_of_degrees(const std::vector<double>& degrees);

/// Joints that swing, each with three frequencies of its own, a frame a tick.
servo::JointTrajectory swinging(std::size_t num_joints, std::size_t num_frames, std::uint32_t seed);

/// The largest error in degrees of poses at these ticks, by the definition: words of the
/// trajectory rounded and limited, and the whole numbers that the robot goes through.
double error_of_ticks(const servo::JointTrajectory& trajectory, const ServoMap& map,
                      const std::vector<std::size_t>& ticks);

/// Key ticks as greedy reduction finds them: the longest segment that keeps to a tolerance, again
/// and again. Empty if there is none.
std::vector<std::size_t> greedy_ticks(const servo::JointTrajectory& trajectory, const ServoMap& map,
                                      double tolerance);

/// The least error that greedy reduction reaches with so many poses, its tolerance bisected.
double greedy_error(const servo::JointTrajectory& trajectory, const ServoMap& map,
                    std::size_t num_poses);

/// The least error of so many poses by the way of Douglas and Peucker: the farthest tick becomes a
/// pose, again and again.
double farthest_first_error(const servo::JointTrajectory& trajectory, const ServoMap& map,
                            std::size_t num_poses);

}  // namespace kinefile::test
