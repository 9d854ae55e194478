// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "kinefile/format.hpp"
#include "kinefile/operation.hpp"
#include "kinefile/world_poses.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// The content of a table of poses: a line for each joint, and for each of its tips, in each frame.
/// A tip's line follows that of its joint and repeats its rotation and direction. The poses come
/// from elsewhere (see `PoseBlocks`), with the arrays that the table requests.
struct PoseTable {
  const Skeleton* skeleton = nullptr;
  const Timeline* timeline = nullptr;
  FrameRange frames;                ///< the frames shown
  std::vector<std::size_t> joints;  ///< the joints shown, in skeleton order
  bool rotations = false;
  bool directions = false;
  bool tips = false;
  double length_scale = 1;  ///< lengths are multiplied by this
};

}  // namespace kinefile

#pragma GCC visibility pop
