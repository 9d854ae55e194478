// SPDX-License-Identifier: MIT
#include "kinematics/limbs.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "base/words.hpp"
#include "kinefile/kinematics.hpp"

namespace kinefile {
namespace {

bool has_word(const std::string& lower, std::string_view word) {
  return lower.find(word) != std::string::npos;
}

bool is_called_leg(const std::string& name) {
  constexpr std::array<std::string_view, 13> kWords = {
      "leg", "thigh", "femur",  "shin",   "tibia",  "calf",  "knee",
      "paw", "hoof",  "\u811a", "\u817f", "\u819d", "\u8db3"};
  const std::string lower = lowered(name);
  return is_called_foot(name) || std::any_of(kWords.begin(), kWords.end(),
                                             [&](auto word) { return has_word(lower, word); });
}

/// The leg that ends at a joint; nothing if it has no length.
std::optional<Leg> leg_to(const Skeleton& skeleton, const std::vector<bool>& is_leg,
                          const std::vector<std::size_t>& first_tips, std::size_t bottom) {
  Leg leg{bottom, bottom};
  for (std::size_t j = bottom; j != kNoParent; j = skeleton.joints[j].parent) {
    if (is_leg[j]) leg.top = j;  // bones between, such as a metatarsal, have other names
  }
  if (leg.top != bottom) return leg;
  if (is_called_foot(skeleton.joints[bottom].name)) {  // a foot alone lies level
    leg.top = skeleton.joints[bottom].parent;
    return leg.top == kNoParent ? std::nullopt : std::optional(leg);
  }
  if (skeleton.joints[bottom].tips.empty()) return std::nullopt;
  leg.tip = first_tips[bottom];
  return leg;
}

}  // namespace

bool is_called_foot(const std::string& name) {
  const std::string lower = lowered(name);
  const bool is_ball = has_word(lower, "ball") && !has_word(lower, "eye");
  return has_word(lower, "foot") || has_word(lower, "toe") || has_word(lower, "ankle") || is_ball ||
         has_word(lower, "\u8db3");
}

std::vector<std::size_t> subtree_sizes(const Skeleton& skeleton) {
  std::vector<std::size_t> sizes(skeleton.joints.size(), 1);
  for (std::size_t j = sizes.size(); j-- > 0;) {  // children before their parents
    const std::size_t parent = skeleton.joints[j].parent;
    if (parent != kNoParent) sizes[parent] += sizes[j];
  }
  return sizes;
}

std::vector<std::size_t> last_of_kind(const Skeleton& skeleton,
                                      const std::vector<bool>& is_of_kind) {
  std::vector<bool> has_one_below(is_of_kind.size());
  for (std::size_t j = is_of_kind.size(); j-- > 0;) {  // children before their parents
    const std::size_t parent = skeleton.joints[j].parent;
    if (parent != kNoParent && (is_of_kind[j] || has_one_below[j])) has_one_below[parent] = true;
  }
  std::vector<std::size_t> last;
  for (std::size_t j = 0; j < is_of_kind.size(); ++j) {
    if (is_of_kind[j] && !has_one_below[j]) last.push_back(j);
  }
  return last;
}

std::vector<Leg> find_legs(const Skeleton& skeleton) {
  std::vector<bool> is_leg;
  for (const Joint& joint : skeleton.joints) is_leg.push_back(is_called_leg(joint.name));
  std::vector<Leg> legs;
  // A prefix that all names have says nothing.
  if (std::find(is_leg.begin(), is_leg.end(), false) == is_leg.end()) return legs;
  const auto first_tips = first_tips_of_joints(skeleton);
  for (const std::size_t bottom : last_of_kind(skeleton, is_leg)) {
    if (const auto leg = leg_to(skeleton, is_leg, first_tips, bottom)) legs.push_back(*leg);
  }
  return legs;
}

Vec3 direction_of(const Leg& leg, const PoseArrays& poses, std::size_t row) {
  const Vec3 bottom =
      leg.tip ? tip_position(poses, row, *leg.tip) : joint_position(poses, row, leg.bottom);
  return (joint_position(poses, row, leg.top) - bottom).normalized();
}

std::vector<std::size_t> pairs_on_trunk(const Skeleton& skeleton,
                                        const std::vector<std::size_t>& pairs) {
  constexpr double kApart = 1e-3;  // of the skeleton's size: nearer joints are at one place
  const WorldPoses rest = sampled_poses({skeleton, {}});
  const double least = kApart * rest_size(skeleton);
  std::vector<bool> is_in_limb(pairs.size(), false);
  std::vector<std::size_t> on_trunk(pairs.size(), kNoParent);
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    const std::size_t parent = skeleton.joints[j].parent;
    is_in_limb[j] = parent != kNoParent && is_in_limb[parent];
    if (is_in_limb[j] || pairs[j] == kNoParent || pairs[j] == j) continue;
    const Vec3 apart = joint_position(rest, 0, j) - joint_position(rest, 0, pairs[j]);
    if (!(apart.norm() > least)) continue;
    is_in_limb[j] = true;
    on_trunk[j] = pairs[j];
  }
  return on_trunk;
}

std::optional<bool> stands_at_rest(const Skeleton& skeleton, std::size_t up) {
  constexpr double kDown = 0.7;  // the cosine of the largest angle
  const std::vector<Leg> legs = find_legs(skeleton);
  if (legs.empty()) return std::nullopt;
  const WorldPoses rest = sampled_poses({skeleton, {}});
  Vec3 sum = Vec3::Zero();
  for (const Leg& leg : legs) sum += direction_of(leg, rest, 0);
  return sum[static_cast<Eigen::Index>(up)] > kDown * static_cast<double>(legs.size());
}

namespace {

constexpr std::size_t kMostFrames = 64;

}  // namespace

std::size_t step_of_samples(std::size_t num_frames) {
  return (num_frames + kMostFrames - 1) / kMostFrames;
}

WorldPoses sampled_poses(const Motion& motion) {
  const Clip rest = rest_clip(motion.skeleton);
  const Clip& clip = motion.clip.num_frames > 0 ? motion.clip : rest;
  KinematicsOptions options;
  options.frame_step = step_of_samples(clip.num_frames);
  options.num_frames = kMostFrames;
  options.tips = true;
  return forward_kinematics(motion.skeleton, clip, options);
}

Vec3 joint_position(const PoseArrays& poses, std::size_t row, std::size_t joint) {
  return Vec3(&poses.positions[(row * poses.num_joints + joint) * 3]);
}

Vec3 tip_position(const PoseArrays& poses, std::size_t row, std::size_t tip) {
  return Vec3(&poses.tips[(row * poses.num_tips + tip) * 3]);
}

}  // namespace kinefile
