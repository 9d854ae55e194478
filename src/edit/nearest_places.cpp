// SPDX-License-Identifier: MIT
#include "edit/nearest_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kinefile::edit {
namespace {

constexpr std::size_t kLeafSize = 8;
/// Ends decide between joints at one place.
constexpr double kEndShare = 0.1;

/// Never more than the distance to a place in the box: rounding keeps the order, so that a box of
/// equal places has their very distance.
double distance_to_box(const Vec3& place, const Vec3& low, const Vec3& high) {
  return (low - place).cwiseMax(place - high).cwiseMax(0).norm();
}

}  // namespace

struct NearestPlaces::Query {
  Vec3 place;
  Vec3 end;
  double distance;
  std::size_t excluded;
  double best = std::numeric_limits<double>::infinity();
  std::size_t joint = kNoParent;

  /// Whether a box can hold a joint that is better than the best one.
  bool may_be_in(const Node& node) const {
    if (node.first_joint == kNoParent) return false;
    const double apart = distance_to_box(place, node.low[0], node.high[0]);
    const double least = apart + kEndShare * distance_to_box(end, node.low[1], node.high[1]);
    return apart <= distance && (least < best || (least == best && node.first_joint < joint));
  }
};

NearestPlaces::NearestPlaces(const JointPlaces& places, const std::vector<std::size_t>& members)
    : places_(places),
      leaf_of_joint_(places.joints.size(), 0),
      is_removed_(places.joints.size(), 1) {
  for (const std::size_t joint : members) {
    if (!places.joints[joint].allFinite() || !places.ends[joint].allFinite()) continue;
    members_.push_back(joint);
    is_removed_[joint] = 0;
  }
  if (!members_.empty()) build(0, members_.size(), 0);
}

std::size_t NearestPlaces::build(std::size_t first, std::size_t last, std::size_t parent) {
  const std::size_t index = nodes_.size();
  Node& node = nodes_.emplace_back();
  node.first = first;
  node.last = last;
  node.parent = parent;
  for (std::size_t k = 0; k < 2; ++k) {
    const std::vector<Vec3>& of = k == 0 ? places_.joints : places_.ends;
    node.low[k] = node.high[k] = of[members_[first]];
    for (std::size_t i = first + 1; i < last; ++i) {
      node.low[k] = node.low[k].cwiseMin(of[members_[i]]);
      node.high[k] = node.high[k].cwiseMax(of[members_[i]]);
    }
  }
  if (last - first > kLeafSize) {
    split(index);
  } else {
    for (std::size_t i = first; i < last; ++i) leaf_of_joint_[members_[i]] = index;
  }
  update(index);
  return index;
}

/// Divides a node in the middle of its longest side.
void NearestPlaces::split(std::size_t index) {
  const std::size_t first = nodes_[index].first;
  const std::size_t last = nodes_[index].last;
  Eigen::Index axis = 0;
  const double of_joints = (nodes_[index].high[0] - nodes_[index].low[0]).maxCoeff(&axis);
  Eigen::Index axis_of_ends = 0;
  const double of_ends = (nodes_[index].high[1] - nodes_[index].low[1]).maxCoeff(&axis_of_ends);
  const bool is_by_ends = kEndShare * of_ends > of_joints;
  const std::vector<Vec3>& of = is_by_ends ? places_.ends : places_.joints;
  if (is_by_ends) axis = axis_of_ends;
  const std::size_t middle = (first + last) / 2;
  const auto at = [this](std::size_t i) {
    return members_.begin() + static_cast<std::ptrdiff_t>(i);
  };
  std::nth_element(at(first), at(middle), at(last), [&](std::size_t a, std::size_t b) {
    return std::pair(of[a][axis], a) < std::pair(of[b][axis], b);
  });
  const std::size_t left = build(first, middle, index);
  const std::size_t right = build(middle, last, index);
  nodes_[index].left = left;
  nodes_[index].right = right;
}

void NearestPlaces::update(std::size_t index) {
  Node& node = nodes_[index];
  node.first_joint = kNoParent;
  if (node.left != 0) {
    node.first_joint = std::min(nodes_[node.left].first_joint, nodes_[node.right].first_joint);
    return;
  }
  for (std::size_t i = node.first; i < node.last; ++i) {
    if (is_removed_[members_[i]] == 0) node.first_joint = std::min(node.first_joint, members_[i]);
  }
}

void NearestPlaces::remove(std::size_t joint) {
  if (is_removed_[joint] != 0) return;
  is_removed_[joint] = 1;
  for (std::size_t node = leaf_of_joint_[joint];; node = nodes_[node].parent) {
    update(node);
    if (node == 0) return;
  }
}

std::size_t NearestPlaces::nearest(const Vec3& place, const Vec3& end, double distance,
                                   std::size_t excluded) const {
  Query query{place, end, distance, excluded};
  if (!nodes_.empty()) search(0, query);
  return query.joint;
}

void NearestPlaces::search(std::size_t index, Query& query) const {
  const Node& node = nodes_[index];
  if (!query.may_be_in(node)) return;
  if (node.left == 0) {
    search_leaf(node, query);
    return;
  }
  // Of equals the first joint counts, so its side goes first.
  const auto distance_of = [&](std::size_t side) {
    const Node& own = nodes_[side];
    const double least = distance_to_box(query.place, own.low[0], own.high[0]) +
                         kEndShare * distance_to_box(query.end, own.low[1], own.high[1]);
    return std::pair(least, own.first_joint);
  };
  const bool is_left_first = distance_of(node.left) < distance_of(node.right);
  search(is_left_first ? node.left : node.right, query);
  search(is_left_first ? node.right : node.left, query);
}

void NearestPlaces::search_leaf(const Node& node, Query& query) const {
  for (std::size_t i = node.first; i < node.last; ++i) {
    const std::size_t joint = members_[i];
    if (is_removed_[joint] != 0 || joint == query.excluded) continue;
    const double apart = (places_.joints[joint] - query.place).norm();
    const double score = apart + kEndShare * (places_.ends[joint] - query.end).norm();
    if (!(apart <= query.distance)) continue;
    if (score < query.best || (score == query.best && joint < query.joint)) {
      query.best = score;
      query.joint = joint;
    }
  }
}

}  // namespace kinefile::edit
