// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "kinefile/motion.hpp"

namespace kinefile::retime {

/// The rotations of joints in some frames, for comparing frames.
struct FrameAngles {
  std::size_t num_joints = 0;
  std::vector<double> rotations;  ///< [frame][joint][4], in the parents' frames
};

/// The positions of joints in some frames, minus their mean on the ground (y is up).
struct FramePoints {
  std::size_t num_joints = 0;
  std::vector<double> points;   ///< [frame][joint][3]
  std::vector<double> spreads;  ///< [frame], the sum of squared distances from the mean
};

/// \param joints  the joints to use, in this order
FrameAngles angles_of_frames(const Motion& motion, const std::vector<std::size_t>& joints);
/// \param scale  the factor for all lengths
/// \param up     the axis that points up in the motion
FramePoints points_of_frames(const Motion& motion, const std::vector<std::size_t>& joints,
                             double scale, std::size_t up);

/// The sum of the squared angles, in radians, between the joints of two frames; 0 for equal ones.
double distance(const FrameAngles& a, std::size_t frame_a, const FrameAngles& b,
                std::size_t frame_b);

/// The sum of the squared distances between the joints of two frames after the best rotation and
/// translation of one of them on the ground; 0 for equal ones.
/// Source: Kovar, Gleicher and Pighin, SIGGRAPH 2002, with weights of 1. With the means at 0 the
/// best rotation is by atan2(s, c), where c = sum(x x' + z z') and s = sum(x z' - x' z), and the
/// residual on the ground is sum(x^2 + z^2) + sum(x'^2 + z'^2) - 2 sqrt(c^2 + s^2).
double distance(const FramePoints& a, std::size_t frame_a, const FramePoints& b,
                std::size_t frame_b);

}  // namespace kinefile::retime
