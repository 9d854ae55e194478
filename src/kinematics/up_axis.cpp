// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinefile/evidence.hpp"
#include "kinefile/kinematics.hpp"
#include "kinematics/limbs.hpp"

namespace kinefile {
namespace {

constexpr Eigen::Index kY = 1;
constexpr Eigen::Index kZ = 2;

// How much each kind of evidence counts. Frames count most, because a rest pose need not stand.
constexpr double kFrameWeight = 1;
constexpr double kGroundWeight = 0.8;
constexpr double kRestWeight = 0.6;
constexpr double kClearMargin = 0.5;
constexpr double kClearMarginInConflict = 0.7;
constexpr double kConflict = 0.3;
constexpr double kLeastMargin = 0.1;  // below it, y is as good as z

/// One kind of evidence: how strongly it speaks for each axis, from 0 to 1.
struct UpEvidence {
  double weight = 0;
  Eigen::Array3d strength = Eigen::Array3d::Zero();
  std::string words;  ///< what it shows
};

/// The mean direction of the legs, upwards; only components towards positive axes are kept.
Eigen::Array3d strength_of_legs(const WorldPoses& poses, const std::vector<Leg>& legs) {
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (std::size_t f = 0; f < poses.num_frames; ++f) {
    for (const Leg& leg : legs) {
      const Vec3 direction = direction_of(leg, poses, f);
      if (!direction.allFinite() || direction.isZero()) continue;
      sum += direction;
      ++count;
    }
  }
  if (count == 0) return Eigen::Array3d::Zero();
  return (sum / count).array().max(0.0);
}

/// The lowest coordinates of all joints and tips in a row of poses, along each axis.
Eigen::Array3d lowest_in(const WorldPoses& poses, std::size_t frame) {
  Eigen::Array3d lowest = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  for (std::size_t j = 0; j < poses.num_joints; ++j) {
    lowest = lowest.min(joint_position(poses, frame, j).array());
  }
  for (std::size_t t = 0; t < poses.num_tips; ++t) {
    lowest = lowest.min(tip_position(poses, frame, t).array());
  }
  return lowest;
}

/// Without legs: half of the mean height of the joints above the lowest point, along y and z, as
/// shares of both. Half, because it says little: long things lie, too.
Eigen::Array3d strength_of_heights(const WorldPoses& poses) {
  Eigen::Array3d heights = Eigen::Array3d::Zero();
  for (std::size_t f = 0; f < poses.num_frames; ++f) {
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    for (std::size_t j = 0; j < poses.num_joints; ++j) {
      sum += joint_position(poses, f, j).array();
    }
    const Eigen::Array3d height = sum / static_cast<double>(poses.num_joints) - lowest_in(poses, f);
    if (height.isFinite().all()) heights += height;
  }
  const double both = heights[kY] + heights[kZ];
  if (!(both > 0)) return Eigen::Array3d::Zero();
  return heights / both / 2;
}

/// How steady the lowest point is along each axis, compared with the other one: 0.5 if it moves
/// half as much, 1 if a quarter.
Eigen::Array3d strength_of_ground(const WorldPoses& poses, double size) {
  constexpr double kLeastTravel = 0.02;  // of the skeleton's size
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  Eigen::Array3d squares = Eigen::Array3d::Zero();
  double count = 0;
  for (std::size_t f = 0; f < poses.num_frames; ++f) {
    const Eigen::Array3d lowest = lowest_in(poses, f);
    if (!lowest.isFinite().all()) continue;
    sum += lowest;
    squares += lowest.square();
    ++count;
  }
  Eigen::Array3d strength = Eigen::Array3d::Zero();
  if (count < 2) return strength;
  const Eigen::Array3d spread = (squares / count - (sum / count).square()).max(0.0).sqrt();
  const Eigen::Index steady = spread[kZ] < spread[kY] ? kZ : kY;
  const double moved = spread[kY + kZ - steady];
  if (!(moved > kLeastTravel * size)) return strength;
  const double least = std::max(spread[steady], 1e-3 * moved);
  strength[steady] = std::clamp(std::log2(moved / least) / 2, 0.0, 1.0);
  return strength;
}

std::vector<UpEvidence> evidence_of(const Motion& motion) {
  const std::vector<Leg> legs = find_legs(motion.skeleton);
  const Motion at_rest{motion.skeleton, {}};
  const WorldPoses frames = sampled_poses(motion);
  const WorldPoses rest = sampled_poses(at_rest);
  const double size = rest_size(motion.skeleton);
  const bool has_frames = motion.clip.num_frames > 0;
  std::vector<UpEvidence> all;
  if (!legs.empty()) {
    if (has_frames) {
      all.push_back(
          {kFrameWeight, strength_of_legs(frames, legs), "the legs hang down in the motion"});
    }
    all.push_back({kRestWeight, strength_of_legs(rest, legs), "the legs hang down at rest"});
  } else {
    if (has_frames) {
      all.push_back({kFrameWeight, strength_of_heights(frames), "joints are high in the motion"});
    }
    all.push_back({kRestWeight, strength_of_heights(rest), "joints are high at rest"});
  }
  if (has_frames) {
    all.push_back(
        {kGroundWeight, strength_of_ground(frames, size), "the lowest point stays at one height"});
  }
  return all;
}

/// The evidence that speaks more for one axis than for another.
std::string words_for(Eigen::Index axis, Eigen::Index other, const std::vector<UpEvidence>& all) {
  constexpr double kNoticed = 0.1;
  std::vector<std::string> words;
  for (const UpEvidence& evidence : all) {
    const double difference = evidence.strength[axis] - evidence.strength[other];
    if (difference > kNoticed) words.push_back(evidence.words);
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string reason_for(Eigen::Index axis, const std::vector<UpEvidence>& all) {
  const Eigen::Index other = kY + kZ - axis;
  const std::string words = words_for(axis, other, all);
  const std::string against = words_for(other, axis, all);
  std::string reason = words.empty() ? "nothing shows it" : words;
  if (!against.empty()) reason += fmt::format("; for {} speaks: {}", "xyz"[other], against);
  return reason;
}

}  // namespace

UpAxis find_up_axis(const Motion& motion) {
  if (motion.skeleton.up) return {*motion.skeleton.up, Certainty::Known, "it is defined"};
  UpAxis up;
  if (motion.skeleton.joints.empty()) return up;
  const std::vector<UpEvidence> all = evidence_of(motion);
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (const UpEvidence& evidence : all) sum += evidence.weight * evidence.strength;
  const double margin = sum[kZ] - sum[kY];
  up.axis = margin > kLeastMargin ? 2 : 1;
  const auto axis = static_cast<Eigen::Index>(up.axis);
  double against = 0;
  for (const UpEvidence& evidence : all) {
    const double difference = evidence.strength[kY + kZ - axis] - evidence.strength[axis];
    against += evidence.weight * std::max(difference, 0.0);
  }
  const double needed = against > kConflict ? kClearMarginInConflict : kClearMargin;
  up.certainty = std::abs(margin) < needed ? Certainty::Doubtful : Certainty::Clear;
  up.reason = reason_for(axis, all);
  return up;
}

UpAxis settle_up_axis(const Motion& motion, Diagnostics& diagnostics) {
  const UpAxis up = find_up_axis(motion);
  if (up.certainty == Certainty::Doubtful && !motion.skeleton.joints.empty()) {
    diagnostics.add(Severity::Note, "MOT005",
                    fmt::format("{} is taken to point up, but that is doubtful: {} (--up-in says "
                                "which axis does)",
                                "xyz"[up.axis], up.reason));
  }
  return up;
}

}  // namespace kinefile
