// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kinefile/array.hpp"
#include "kinefile/motion.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// How a joint moves in the world, over all frames of a motion.
struct JointCurves {
  std::size_t joint = 0;
  Array<double> positions;       ///< [frame][3], in the skeleton's unit of length
  Array<double> speeds;          ///< [frame], of the positions, in units of length per second
  Array<double> angular_speeds;  ///< [frame], of the joint's rotation, in degrees per second
};

/// Computes the curves of some joints. Memory grows with the frames of these joints only: all
/// others are placed in blocks of frames.
/// A speed is the central difference, from the frame before to the frame after, at the frames' own
/// times; at the first and the last frame it is one-sided. An angular speed adds the rotation from
/// the frame before and that to the frame after, each of up to half a turn, so it is right up to
/// half a turn per frame. The speeds of a single frame are 0.
/// Where a value that is not finite moves a joint, and where times do not increase, the numbers are
/// not finite.
/// \param joints  indices of joints of the motion's skeleton; precondition
/// \returns       one per element of `joints`, in their order
std::vector<JointCurves> joint_curves(const Motion& motion, std::span<const std::size_t> joints);

}  // namespace kinefile

#pragma GCC visibility pop
