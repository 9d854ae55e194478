// SPDX-License-Identifier: MIT
#include "edit/mirror_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "edit/nearest_places.hpp"
#include "kinefile/kinematics.hpp"
#include "model/side_names.hpp"

namespace kinefile::edit {
namespace {

/// Ends are in the plane up to this, of the skeleton's size.
constexpr double kEndsInPlane = 0.02;

std::vector<std::size_t> roots_of_joints(const Skeleton& skeleton) {
  std::vector<std::size_t> roots;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const std::size_t parent = skeleton.joints[j].parent;
    roots.push_back(parent == kNoParent ? j : roots[parent]);
  }
  return roots;
}

/// A place reflected in the plane with a normal.
Vec3 image_of(const Vec3& place, const Vec3& normal) {
  return place - 2 * normal.dot(place) * normal;
}

/// Looks for partners in one pose.
class Matcher {
 public:
  Matcher(const Skeleton& skeleton, const JointPlaces& places, const Vec3& normal,
          const std::vector<std::size_t>& pairs)
      : skeleton_(skeleton), places_(places), normal_(normal), depths_(depths_of(skeleton)) {
    std::vector<std::vector<std::size_t>> members;
    for (std::size_t j = 0; j < pairs.size(); ++j) {
      if (pairs[j] != kNoParent) continue;
      members.resize(std::max(members.size(), depths_[j] + 1));
      members[depths_[j]].push_back(j);
    }
    of_depth_.reserve(members.size());
    for (const auto& own : members) of_depth_.emplace_back(places, own);
  }

  /// Two joints in the plane, such as hips at the root, are each other's halves if their ends are
  /// not in it.
  bool is_in_plane(std::size_t joint, double distance) const {
    if (!(std::abs(normal_.dot(places_.joints[joint])) <= distance)) return false;
    const Joint& own = skeleton_.joints[joint];
    if (own.parent != kNoParent && has_side(own.name)) return false;
    const bool are_ends_in_plane = std::abs(normal_.dot(places_.ends[joint])) <=
                                   std::max(distance, kEndsInPlane * places_.size);
    return are_ends_in_plane || partner_of(joint, distance) == kNoParent;
  }

  /// The joint without a partner that is nearest to the image of another.
  std::size_t partner_of(std::size_t joint, double distance) const {
    return of_depth_[depths_[joint]].nearest(image_of(places_.joints[joint], normal_),
                                             image_of(places_.ends[joint], normal_), distance,
                                             joint);
  }

  /// Makes two joints, or one and itself, each other's partners.
  void pair(std::size_t a, std::size_t b, std::vector<std::size_t>& pairs) {
    pairs[a] = b;
    pairs[b] = a;
    of_depth_[depths_[a]].remove(a);
    of_depth_[depths_[b]].remove(b);
  }

 private:
  const Skeleton& skeleton_;
  const JointPlaces& places_;
  Vec3 normal_;
  std::vector<std::size_t> depths_;
  std::vector<NearestPlaces> of_depth_;  ///< joints without a partner
};

}  // namespace

JointPlaces places_of(const Skeleton& skeleton, double size, const PoseArrays& poses,
                      std::size_t row) {
  const std::size_t num_joints = skeleton.joints.size();
  const auto roots = roots_of_joints(skeleton);
  const auto first_tips = first_tips_of_joints(skeleton);
  JointPlaces places;
  places.size = size;
  places.joints.reserve(num_joints);
  for (std::size_t j = 0; j < num_joints; ++j) {
    const Vec3 root(&poses.positions[(row * num_joints + roots[j]) * 3]);
    places.joints.emplace_back(Vec3(&poses.positions[(row * num_joints + j) * 3]) - root);
  }
  std::vector<double> counts(num_joints, 0);
  places.ends.assign(num_joints, Vec3::Zero());
  for (std::size_t j = 0; j < num_joints; ++j) {
    const Vec3 root(&poses.positions[(row * num_joints + roots[j]) * 3]);
    for (std::size_t t = 0; t < skeleton.joints[j].tips.size(); ++t) {
      const double* tip = &poses.tips[(row * poses.num_tips + first_tips[j] + t) * 3];
      places.ends[j] += Vec3(tip) - root;
      ++counts[j];
    }
    const std::size_t parent = skeleton.joints[j].parent;
    if (parent == kNoParent) continue;
    places.ends[parent] += places.joints[j];
    ++counts[parent];
  }
  for (std::size_t j = 0; j < num_joints; ++j) {
    places.ends[j] = counts[j] > 0 ? Vec3(places.ends[j] / counts[j]) : places.joints[j];
  }
  return places;
}

JointPlaces rest_places(const Skeleton& skeleton) {
  const WorldPoses poses = forward_kinematics(skeleton, rest_clip(skeleton), {.tips = true});
  return places_of(skeleton, rest_size(skeleton), poses, 0);
}

void pair_by_place(const Skeleton& skeleton, const JointPlaces& places, const Vec3& normal,
                   const PairTolerance& tolerance, std::vector<std::size_t>& pairs) {
  Matcher matcher(skeleton, places, normal, pairs);
  const auto pair_in_plane = [&](double distance) {
    for (std::size_t j = 0; j < pairs.size(); ++j) {
      if (pairs[j] == kNoParent && matcher.is_in_plane(j, distance)) matcher.pair(j, j, pairs);
    }
  };
  pair_in_plane(tolerance.strict * places.size);
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    if (pairs[j] != kNoParent) continue;
    const std::size_t other = matcher.partner_of(j, tolerance.near * places.size);
    if (other != kNoParent) matcher.pair(j, other, pairs);
  }
  // Spines from motion capture are not exactly straight.
  pair_in_plane(tolerance.near * places.size);
}

void pair_with_themselves(const Skeleton& skeleton, std::vector<std::size_t>& pairs) {
  bool has_pairs = false;
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    has_pairs = has_pairs || (pairs[j] != kNoParent && pairs[j] != j);
  }
  for (std::size_t j = 0; has_pairs && j < pairs.size(); ++j) {
    const std::size_t parent = skeleton.joints[j].parent;
    const bool is_on_trunk = parent == kNoParent || pairs[parent] == parent;
    if (pairs[j] == kNoParent && is_on_trunk && !has_side(skeleton.joints[j].name)) pairs[j] = j;
  }
}

double asymmetry(const JointPlaces& places, const Vec3& normal,
                 const std::vector<std::size_t>& pairs) {
  double largest = 0;
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    if (pairs[j] == kNoParent) continue;
    const double joint = (image_of(places.joints[j], normal) - places.joints[pairs[j]]).norm();
    const double end = (image_of(places.ends[j], normal) - places.ends[pairs[j]]).norm();
    if (!std::isfinite(joint + end)) return std::numeric_limits<double>::quiet_NaN();
    largest = std::max({largest, joint, end});
  }
  return places.size > 0 ? largest / places.size : 0;
}

Vec3 distances_of_pairs(const JointPlaces& places, const std::vector<std::size_t>& pairs) {
  Vec3 distances = Vec3::Zero();
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    if (pairs[j] == kNoParent) continue;
    distances += (places.joints[j] - places.joints[pairs[j]]).cwiseAbs();
  }
  return distances;
}

}  // namespace kinefile::edit
