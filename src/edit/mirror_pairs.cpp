// SPDX-License-Identifier: MIT
#include "edit/mirror_pairs.hpp"

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "kinefile/edit.hpp"
#include "kinefile/kinematics.hpp"
#include "kinematics/joint_columns.hpp"

namespace kinefile::edit {
namespace {

struct SidePair {
  std::string_view left;
  std::string_view right;
};

constexpr std::array<SidePair, 4> kWords = {
    {{"Left", "Right"}, {"left", "right"}, {"LEFT", "RIGHT"}, {"左", "右"}}};

/// A name in which every word of one side is replaced by that of the other side.
std::string with_words_swapped(std::string_view name) {
  std::string swapped;
  while (!name.empty()) {
    std::size_t length = 1;
    std::string_view word = name.substr(0, 1);
    for (const SidePair& pair : kWords) {
      const bool is_left = name.starts_with(pair.left);
      if (!is_left && !name.starts_with(pair.right)) continue;
      length = is_left ? pair.left.size() : pair.right.size();
      word = is_left ? pair.right : pair.left;
      break;
    }
    swapped += word;
    name.remove_prefix(length);
  }
  return swapped;
}

/// The letter of the other side, or 0 if the letter stands for no side.
char other_side(char letter) {
  constexpr std::string_view kSides = "lrLR";
  const std::size_t side = kSides.find(letter);
  return side == std::string_view::npos ? '\0' : kSides[side ^ 1];
}

bool is_word_letter(char c) {
  const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  return is_letter || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80;
}

/// Candidate names of a joint's partner, the most certain first.
std::vector<std::string> names_of_other_half(const std::string& name) {
  std::vector<std::string> names;
  if (std::string swapped = with_words_swapped(name); swapped != name) names.push_back(swapped);
  std::vector<std::string> ends;  // a letter that is not a separate word is less certain
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char other = other_side(name[i]);
    const bool is_start = i == 0 || !is_word_letter(name[i - 1]);
    const bool is_end = i + 1 == name.size() || !is_word_letter(name[i + 1]);
    if (other == '\0' || (!is_start && !is_end)) continue;
    std::string swapped = name;
    swapped[i] = other;
    (is_start && is_end ? names : ends).push_back(std::move(swapped));
  }
  names.insert(names.end(), ends.begin(), ends.end());
  return names;
}

std::vector<std::size_t> depths_of(const Skeleton& skeleton) {
  std::vector<std::size_t> depths;
  for (const Joint& joint : skeleton.joints) {
    depths.push_back(joint.parent == kNoParent ? 0 : depths[joint.parent] + 1);
  }
  return depths;
}

std::vector<Vec3> rest_positions(const Skeleton& skeleton) {
  const WorldPoses poses = forward_kinematics(skeleton, rest_clip(skeleton));
  std::vector<Vec3> places;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    places.emplace_back(Eigen::Map<const Vec3>(&poses.positions[j * 3]));
  }
  return places;
}

std::vector<std::size_t> roots_of_joints(const Skeleton& skeleton) {
  std::vector<std::size_t> roots;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const std::size_t parent = skeleton.joints[j].parent;
    roots.push_back(parent == kNoParent ? j : roots[parent]);
  }
  return roots;
}

/// The joint without a partner that is nearest to a place, if one is within a distance.
std::size_t nearest_single(const std::vector<Vec3>& places, const std::vector<std::size_t>& depths,
                           const std::vector<std::size_t>& pairs, std::size_t joint,
                           const Vec3& place, double distance) {
  std::size_t nearest = kNoParent;
  for (std::size_t j = 0; j < places.size(); ++j) {
    if (j == joint || pairs[j] != kNoParent || depths[j] != depths[joint]) continue;
    if (!((places[j] - place).norm() <= distance)) continue;
    distance = (places[j] - place).norm();
    nearest = j;
  }
  return nearest;
}

void pair_by_place(const Skeleton& skeleton, std::size_t axis, std::vector<std::size_t>& pairs) {
  constexpr double kInPlane = 1e-3;
  constexpr double kNear = 0.01;
  const auto normal = static_cast<Eigen::Index>(axis);
  const double size = rest_size(skeleton);
  const auto places = rest_positions(skeleton);
  const auto depths = depths_of(skeleton);
  const auto roots = roots_of_joints(skeleton);
  const auto height = [&](std::size_t j) { return places[j][normal] - places[roots[j]][normal]; };
  const auto pair_in_plane = [&](double distance) {
    for (std::size_t j = 0; j < pairs.size(); ++j) {
      if (pairs[j] == kNoParent && std::abs(height(j)) <= distance) pairs[j] = j;
    }
  };
  pair_in_plane(kInPlane * size);
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    if (pairs[j] != kNoParent) continue;
    Vec3 image = places[j];
    image[normal] -= 2 * height(j);
    const std::size_t other = nearest_single(places, depths, pairs, j, image, kNear * size);
    if (other == kNoParent) continue;
    pairs[j] = other;
    pairs[other] = j;
  }
  pair_in_plane(kNear * size);  // spines from motion capture are not exactly straight
}

}  // namespace

std::vector<std::size_t> pairs_by_name(const Skeleton& skeleton) {
  const auto depths = depths_of(skeleton);
  std::map<std::string, std::vector<std::size_t>> joints_of_name;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    joints_of_name[skeleton.joints[j].name].push_back(j);
  }
  std::vector<std::size_t> pairs(skeleton.joints.size(), kNoParent);
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    if (pairs[j] != kNoParent) continue;
    for (const std::string& name : names_of_other_half(skeleton.joints[j].name)) {
      const auto others = joints_of_name.find(name);
      if (others == joints_of_name.end()) continue;
      for (const std::size_t other : others->second) {
        if (pairs[j] != kNoParent || pairs[other] != kNoParent || depths[other] != depths[j]) {
          continue;
        }
        pairs[j] = other;
        pairs[other] = j;
      }
    }
  }
  return pairs;
}

std::vector<std::size_t> mirror_pairs(const Skeleton& skeleton, std::size_t axis) {
  auto pairs = pairs_by_name(skeleton);
  if (!pairs.empty()) pair_by_place(skeleton, axis, pairs);
  return pairs;
}

bool lie_opposite(const Skeleton& skeleton, const std::vector<std::size_t>& pairs,
                  std::size_t axis) {
  const auto places = rest_positions(skeleton);
  double along = 0;
  double across = 0;
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    if (pairs[j] == kNoParent) continue;
    Vec3 apart = places[j] - places[pairs[j]];
    along += std::abs(std::exchange(apart[static_cast<Eigen::Index>(axis)], 0.0));
    across += apart.norm();
  }
  return along >= across;
}

std::size_t guess_mirror_axis(const Skeleton& skeleton) {
  if (skeleton.joints.empty()) return 0;
  const auto pairs = pairs_by_name(skeleton);
  const auto places = rest_positions(skeleton);
  Vec3 apart = Vec3::Zero();
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    if (pairs[j] != kNoParent) apart += (places[j] - places[pairs[j]]).cwiseAbs();
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (apart[static_cast<Eigen::Index>(k)] > apart[static_cast<Eigen::Index>(axis)]) axis = k;
  }
  return axis;
}

}  // namespace kinefile::edit
