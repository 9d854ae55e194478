// SPDX-License-Identifier: MIT
#include "retime/feet.hpp"

#include <algorithm>
#include <cmath>

#include "kinefile/kinematics.hpp"
#include "kinematics/limbs.hpp"

namespace kinefile::retime {

std::vector<FootPoint> find_foot_points(const Skeleton& skeleton) {
  std::vector<bool> is_foot;
  for (const Joint& joint : skeleton.joints) is_foot.push_back(is_called_foot(joint.name));
  const auto first_tips = first_tips_of_joints(skeleton);
  std::vector<FootPoint> points;
  for (const std::size_t j : last_of_kind(skeleton, is_foot)) {
    points.push_back({j, false, 0});
    const std::size_t num_own_tips = skeleton.joints[j].tips.size();
    for (std::size_t t = 0; t < num_own_tips; ++t) points.push_back({j, true, first_tips[j] + t});
  }
  return points;
}

FootTracks track_feet(const Motion& motion, const std::vector<FootPoint>& points) {
  FootTracks tracks;
  tracks.positions.resize(points.size());
  KinematicsOptions options;
  options.num_frames = frames_per_block(motion.skeleton);
  options.tips = true;
  for (; options.first_frame < motion.clip.num_frames; options.first_frame += options.num_frames) {
    const WorldPoses poses = forward_kinematics(motion.skeleton, motion.clip, options);
    for (std::size_t row = 0; row < poses.num_frames; ++row) {
      for (std::size_t p = 0; p < points.size(); ++p) {
        const Vec3 position = points[p].is_tip ? tip_position(poses, row, points[p].tip)
                                               : joint_position(poses, row, points[p].joint);
        tracks.positions[p].push_back(position);
      }
    }
  }
  return tracks;
}

}  // namespace kinefile::retime
