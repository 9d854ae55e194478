// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "kinefile/array.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// Poses of all joints over some frames. Arrays that were not requested are empty.
struct PoseArrays {
  std::size_t first_frame = 0;  ///< the clip's frame of row 0
  std::size_t frame_step = 1;   ///< how many frames row 1 is after row 0
  std::size_t num_frames = 0;   ///< rows
  std::size_t num_joints = 0;
  std::size_t num_tips = 0;
  Array<double> positions;   ///< [frame][joint][3], in the skeleton's unit of length
  Array<double> rotations;   ///< [frame][joint][4], unit quaternions w x y z, w >= 0
  Array<double> directions;  ///< [frame][joint][3], unit vectors along the bones
  Array<double> tips;        ///< [frame][tip][3], the tips of joint 0 first
};

/// Poses in the world: world_from_joint.
struct WorldPoses : PoseArrays {};

/// Poses in the frame of each joint's parent: parent_from_joint; a root's parent is the world.
struct LocalPoses : PoseArrays {};

}  // namespace kinefile

#pragma GCC visibility pop
