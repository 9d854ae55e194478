// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "kinefile/motion.hpp"

namespace kinefile::retime {

/// A contact point of a foot: a joint, or one of its tips.
struct FootPoint {
  std::size_t joint = 0;
  bool is_tip = false;
  std::size_t tip = 0;  ///< among the tips of all joints
};

/// The points of a skeleton's feet, found by the names of joints: of the joints named foot, toe,
/// ankle or ball (in any case) or in Japanese, the ones furthest from the root, and their tips. For
/// a toe, the joint is included because the ball of the foot stays on the ground longer than the
/// tip.
std::vector<FootPoint> find_foot_points(const Skeleton& skeleton);

/// The positions of foot points in every frame of a clip.
struct FootTracks {
  std::vector<std::vector<Vec3>> positions;  ///< [foot point][frame]
};

/// Computes the positions of foot points in a clip.
FootTracks track_feet(const Motion& motion, const std::vector<FootPoint>& points);

}  // namespace kinefile::retime
