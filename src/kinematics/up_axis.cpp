// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "kinefile/kinematics.hpp"

namespace kinefile {
namespace {

constexpr Eigen::Index kY = 1;
constexpr Eigen::Index kZ = 2;

/// Heights of a figure along y and z, over some frames.
struct Standing {
  std::size_t num_frames = 0;
  Eigen::Array3d height = Eigen::Array3d::Zero();  ///< sum over frames: the joints' mean above the
                                                   ///< lowest point
  Eigen::Array3d lowest = Eigen::Array3d::Zero();  ///< sum over frames: the lowest point
  Eigen::Array3d lowest_squares = Eigen::Array3d::Zero();
};

void add_frame(const WorldPoses& poses, std::size_t frame, Standing& standing) {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  Eigen::Array3d lowest = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  const auto count = static_cast<double>(poses.num_joints);
  for (std::size_t j = 0; j < poses.num_joints; ++j) {
    const Eigen::Map<const Eigen::Array3d> place(
        &poses.positions[(frame * poses.num_joints + j) * 3]);
    sum += place;
    lowest = lowest.min(place);
  }
  for (std::size_t t = 0; t < poses.num_tips; ++t) {
    lowest =
        lowest.min(Eigen::Map<const Eigen::Array3d>(&poses.tips[(frame * poses.num_tips + t) * 3]));
  }
  if (!(sum + lowest).isFinite().all()) return;
  ++standing.num_frames;
  standing.height += sum / count - lowest;
  standing.lowest += lowest;
  standing.lowest_squares += lowest.square();
}

/// The mean height of the joints above the lowest point, minus the variation of that point: large
/// along the axis that points up, because feet return to the same ground.
Eigen::Array3d uprightness(const Standing& standing) {
  const double count = static_cast<double>(std::max<std::size_t>(standing.num_frames, 1));
  const Eigen::Array3d mean = standing.lowest / count;
  const Eigen::Array3d variance = standing.lowest_squares / count - mean.square();
  return standing.height / count - variance.max(0.0).sqrt();
}

}  // namespace

std::size_t guess_up_axis(const Motion& motion) {
  constexpr std::size_t kMostFrames = 64;
  constexpr double kSurely = 1.5;
  if (motion.skeleton.joints.empty()) return kY;
  const Clip rest = rest_clip(motion.skeleton);
  const Clip& clip = motion.clip.num_frames > 0 ? motion.clip : rest;
  KinematicsOptions options;
  options.frame_step = (clip.num_frames + kMostFrames - 1) / kMostFrames;
  options.num_frames = kMostFrames;
  options.tips = true;
  const WorldPoses poses = forward_kinematics(motion.skeleton, clip, options);
  Standing standing;
  for (std::size_t f = 0; f < poses.num_frames; ++f) add_frame(poses, f, standing);
  const Eigen::Array3d upright = uprightness(standing);
  return upright[kZ] > kSurely * std::max(upright[kY], 0.0) ? kZ : kY;
}

}  // namespace kinefile
