// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "kinefile/evidence.hpp"
#include "kinefile/kinematics.hpp"
#include "kinematics/limbs.hpp"
#include "model/side_names.hpp"

namespace kinefile {
namespace {

constexpr double kShowsNothing = 1e-3;  // of the skeleton's size: shorter directions show nothing

/// The left and the right joint of a pair where limbs leave the trunk.
struct LimbPair {
  std::size_t left = 0;
  std::size_t right = 0;
};

std::vector<LimbPair> limb_pairs(const Skeleton& skeleton) {
  const auto pairs = pairs_on_trunk(skeleton, pairs_by_name(skeleton));
  std::vector<LimbPair> limbs;
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    if (pairs[j] == kNoParent) continue;
    const bool is_left = is_left_of(skeleton.joints[j].name, skeleton.joints[pairs[j]].name);
    if (is_left) limbs.push_back({j, pairs[j]});
  }
  return limbs;
}

}  // namespace

Facing find_facing(const Motion& motion, std::size_t up, std::size_t frame) {
  if (motion.skeleton.joints.empty()) return {std::nullopt, "nothing is there"};
  const auto limbs = limb_pairs(motion.skeleton);
  if (limbs.empty()) return {std::nullopt, "no names tell left from right"};
  const Clip rest = rest_clip(motion.skeleton);
  const bool has_frame = frame < motion.clip.num_frames;
  const WorldPoses poses =
      forward_kinematics(motion.skeleton, has_frame ? motion.clip : rest,
                         {.first_frame = has_frame ? frame : 0, .num_frames = 1});
  Vec3 leftwards = Vec3::Zero();
  for (const LimbPair& limb : limbs) {
    leftwards += joint_position(poses, 0, limb.left) - joint_position(poses, 0, limb.right);
  }
  const Vec3 forward = leftwards.cross(Vec3::Unit(static_cast<Eigen::Index>(up)));
  if (!(forward.norm() > kShowsNothing * rest_size(motion.skeleton))) {
    return {std::nullopt, "left and right lie one above the other"};
  }
  const LimbPair& first = limbs.front();
  return {forward.normalized(), fmt::format("the names tell left from right, first {} from {}",
                                            motion.skeleton.joints[first.left].name,
                                            motion.skeleton.joints[first.right].name)};
}

}  // namespace kinefile
