// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "kinefile/motion.hpp"

namespace kinefile::retiming {

/// A point that touches the ground when a foot does: a joint, or one of its tips.
struct FootPoint {
  std::size_t joint = 0;
  bool is_tip = false;
  std::size_t tip = 0;  ///< among the tips of all joints
};

/// The points of a skeleton's feet, found by the names of joints: of those that are called foot,
/// toe, ankle or ball (in any case) or in Japanese, the ones furthest from the root, and their
/// tips: of a toe, the ball of the foot rests longer than the tip.
std::vector<FootPoint> find_foot_points(const Skeleton& skeleton);

/// Where the feet are over a clip, and where the body is above them.
struct FootTracks {
  std::vector<std::vector<Vec3>> positions;  ///< [foot point][frame]
  Vec3 body_from_feet = Vec3::Zero();        ///< the mean of all joints, seen from the mean foot
};

/// Follows foot points through a clip; what is not finite does not count in the means.
FootTracks track_feet(const Motion& motion, const std::vector<FootPoint>& points);

/// Which axis points up: z where the body is further along z from the feet than along x and y,
/// else y.
std::size_t up_axis(const FootTracks& tracks);

}  // namespace kinefile::retiming
