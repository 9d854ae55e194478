// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "kinefile/evidence.hpp"
#include "kinefile/joint_rotation.hpp"
#include "kinefile/kinematics.hpp"
#include "kinematics/joint_columns.hpp"
#include "kinematics/limbs.hpp"

namespace kinefile {
namespace {

constexpr double kTallestInMetres = 10;
constexpr double kTallestInCentimetres = 500;
// Heights in metres that leave no doubt about the unit.
constexpr double kShortest = 0.5;
constexpr double kTallest = 3;

/// The extent of all joints and tips along an axis, in a row of poses.
double height_in(const WorldPoses& poses, std::size_t frame, Eigen::Index axis) {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  const auto include = [&](double height) {
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  };
  for (std::size_t j = 0; j < poses.num_joints; ++j) include(joint_position(poses, frame, j)[axis]);
  for (std::size_t t = 0; t < poses.num_tips; ++t) include(tip_position(poses, frame, t)[axis]);
  return highest - lowest;
}

/// The range of a joint's positions in its parent's frame, over all frames; the largest of three
/// axes.
double range_of(const Joint& joint, const Clip& clip) {
  const auto translations = translations_of(joint);
  if (translations.empty()) return 0;
  Box box;
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    const Vec3 place = position_in_row(joint.offset, translations, clip.row(f));
    if (!place.allFinite()) continue;
    box.min = box.min.cwiseMin(place);
    box.max = box.max.cwiseMax(place);
  }
  return std::max((box.max - box.min).maxCoeff(), 0.0);
}

/// Whether a joint keeps its rotation but for an exporter's last digits.
bool keeps_its_rotation(const Joint& joint, const Motion& motion) {
  constexpr double kMostTurn = 2e-3;  // radians
  const auto rotations = rotations_of(joint);
  if (rotations.empty()) return true;
  const AngleUnit unit = motion.skeleton.angle_unit;
  std::optional<Quat> first;
  for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
    const Quat turned = quaternion_in_row(rotations, motion.clip.row(f), unit);
    if (!turned.coeffs().allFinite()) continue;
    if (!first) first = turned;
    if (angle_between(*first, turned) > kMostTurn) return false;
  }
  return true;
}

}  // namespace

double standing_height(const Motion& motion, std::size_t up) {
  const WorldPoses poses = sampled_poses(motion);
  std::vector<double> heights;
  for (std::size_t f = 0; f < poses.num_frames; ++f) {
    const double height = height_in(poses, f, static_cast<Eigen::Index>(up));
    if (std::isfinite(height)) heights.push_back(height);
  }
  if (heights.empty()) return 0;
  const auto rank = heights.begin() + static_cast<std::ptrdiff_t>((heights.size() - 1) * 3 / 4);
  std::nth_element(heights.begin(), rank, heights.end());
  return *rank;
}

LengthUnit find_length_unit(const Motion& motion) {
  const double known = motion.skeleton.metres_per_unit;
  if (known > 0) return {known, Certainty::Known, "it is defined"};
  const double height = standing_height(motion, find_up_axis(motion).axis);
  if (!(height > 0)) return {1, Certainty::Doubtful, "nothing shows it"};
  LengthUnit unit{1, Certainty::Clear, fmt::format("the figure stands {:.3g} units high", height)};
  if (height > kTallestInMetres) unit.metres = 0.01;
  if (height > kTallestInCentimetres) unit.metres = 0.001;
  const double in_metres = height * unit.metres;
  if (in_metres < kShortest || in_metres > kTallest) unit.certainty = Certainty::Doubtful;
  return unit;
}

std::vector<std::size_t> find_travellers(const Motion& motion) {
  constexpr double kTravel = 0.1;        // of the skeleton's size
  constexpr double kNoise = 1e-3;        // likewise: an exporter's last digits
  constexpr std::size_t kLeastPart = 4;  // a quarter: a ball beside a figure carries nobody
  const std::vector<Joint>& joints = motion.skeleton.joints;
  const double size = rest_size(motion.skeleton);
  const auto sizes = subtree_sizes(motion.skeleton);
  std::vector<bool> is_below_still_root(joints.size(), false);
  std::vector<std::size_t> root_of(joints.size(), kNoParent);
  std::vector<bool> has_traveller(joints.size(), false);
  std::vector<std::size_t> travellers;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const std::size_t parent = joints[j].parent;
    const bool is_root = parent == kNoParent;
    root_of[j] = is_root ? j : root_of[parent];
    const bool is_reached = is_root || is_below_still_root[parent];
    if (!is_reached) continue;
    const double range = range_of(joints[j], motion.clip);
    is_below_still_root[j] = !(range > kNoise * size) && keeps_its_rotation(joints[j], motion);
    const bool is_large = kLeastPart * sizes[j] >= sizes[root_of[j]];
    if (is_below_still_root[j] || !is_large || !(range > kTravel * size)) continue;
    travellers.push_back(j);
    has_traveller[root_of[j]] = true;
  }
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].parent == kNoParent && !has_traveller[j]) travellers.push_back(j);
  }
  std::sort(travellers.begin(), travellers.end());
  return travellers;
}

}  // namespace kinefile
