// SPDX-License-Identifier: MIT
#include <algorithm>

#include "kinefile/kinematics.hpp"

namespace kinefile {
namespace {

/// The vector along a joint's bone; zero if the joint has no children and tips.
Vec3 bone_vector(const Skeleton& skeleton, const Joint& joint,
                 const std::vector<std::size_t>& children) {
  Vec3 sum = Vec3::Zero();
  for (const std::size_t child : children) sum += rest_offset(skeleton.joints[child]);
  if (!children.empty()) return sum / static_cast<double>(children.size());
  for (const Tip& tip : joint.tips) sum += tip.offset;
  return joint.tips.empty() ? sum : sum / static_cast<double>(joint.tips.size());
}

void include_points(std::span<const double> points, Box& box) {
  for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
    const Vec3 point(points[i], points[i + 1], points[i + 2]);
    if (!point.allFinite()) continue;
    box.min = box.min.cwiseMin(point);
    box.max = box.max.cwiseMax(point);
  }
}

}  // namespace

std::size_t frames_per_block(const Skeleton& skeleton) {
  constexpr std::size_t kPoses = std::size_t{1} << 15;
  constexpr std::size_t kMostFrames = 1024;
  const std::size_t num_joints = std::max<std::size_t>(skeleton.joints.size(), 1);
  return std::clamp<std::size_t>(kPoses / num_joints, 1, kMostFrames);
}

Clip rest_clip(const Skeleton& skeleton) {
  Clip clip;
  clip.num_frames = 1;
  clip.num_coordinates = skeleton.coordinates.size();
  clip.values = rest_coordinates(skeleton);
  return clip;
}

std::vector<Vec3> bone_directions(const Skeleton& skeleton) {
  const auto children = children_of_joints(skeleton);
  std::vector<Vec3> directions;
  directions.reserve(skeleton.joints.size());
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Vec3 bone = bone_vector(skeleton, skeleton.joints[j], children[j]);
    const double length = bone.stableNorm();
    directions.push_back(length > 0 ? Vec3(bone / length) : Vec3::UnitY());
  }
  return directions;
}

Box world_extent(const Skeleton& skeleton, const Clip& clip) {
  const std::size_t block = frames_per_block(skeleton);
  Box box;
  for (std::size_t frame = 0; frame < clip.num_frames; frame += block) {
    KinematicsOptions options;
    options.first_frame = frame;
    options.num_frames = block;
    options.tips = true;
    const WorldPoses poses = forward_kinematics(skeleton, clip, options);
    include_points(poses.positions, box);
    include_points(poses.tips, box);
  }
  return box;
}

double rest_size(const Skeleton& skeleton) {
  const Box box = world_extent(skeleton, rest_clip(skeleton));
  return (box.max - box.min).allFinite() ? (box.max - box.min).norm() : 0;
}

}  // namespace kinefile
