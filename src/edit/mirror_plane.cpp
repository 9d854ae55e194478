// SPDX-License-Identifier: MIT
#include "edit/mirror_plane.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "edit/mirror_pairs.hpp"
#include "kinefile/evidence.hpp"
#include "kinefile/kinematics.hpp"
#include "kinematics/limbs.hpp"
#include "model/side_names.hpp"

namespace kinefile::edit {
namespace {

/// A pose is symmetric if joints lie within this of the images of their partners, of the skeleton's
/// size.
constexpr double kSymmetric = 0.05;
constexpr PairTolerance kNearInFrames = {0.01, 0.05};  // people do not stand exactly

/// Pairs of halves in one pose, and how good they are.
struct Match {
  std::vector<std::size_t> pairs;
  Vec3 normal = Vec3::UnitX();
  std::size_t num_lonely = 0;  ///< moving joints without a partner
  std::size_t num_paired = 0;  ///< joints with another joint as partner
  double asymmetry = 0;
};

Match match_of(const Skeleton& skeleton, const JointPlaces& places, const Vec3& normal,
               const PairTolerance& tolerance, const std::vector<std::size_t>& by_name) {
  Match match;
  match.pairs = by_name;
  match.normal = normal;
  pair_by_place(skeleton, places, normal, tolerance, match.pairs);
  for (std::size_t j = 0; j < match.pairs.size(); ++j) {
    const bool is_lonely = match.pairs[j] == kNoParent;
    if (is_lonely && !skeleton.joints[j].dofs.empty()) ++match.num_lonely;
    if (!is_lonely && match.pairs[j] != j) ++match.num_paired;
  }
  match.asymmetry = asymmetry(places, normal, match.pairs);
  return match;
}

Vec3 unit(std::size_t axis) { return Vec3::Unit(static_cast<Eigen::Index>(axis)); }

/// Whether the pairs are further apart along an axis than across it, all together.
bool lie_opposite(const JointPlaces& places, const std::vector<std::size_t>& pairs,
                  std::size_t axis) {
  const auto index = static_cast<Eigen::Index>(axis);
  double along = 0;
  double across = 0;
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    if (pairs[j] == kNoParent) continue;
    Vec3 apart = places.joints[j] - places.joints[pairs[j]];
    along += std::abs(std::exchange(apart[index], 0.0));
    across += apart.norm();
  }
  return along >= across;
}

bool has_pairs(const std::vector<std::size_t>& pairs) {
  return std::any_of(pairs.begin(), pairs.end(), [](std::size_t j) { return j != kNoParent; });
}

/// The axis between the halves at rest: the wanted one if they lie on its two sides, otherwise the
/// one along which named halves are furthest apart. Without names, the one that pairs most joints.
std::size_t axis_at_rest(const Skeleton& skeleton, const JointPlaces& places,
                         std::optional<std::size_t> wanted,
                         const std::vector<std::size_t>& by_name) {
  if (has_pairs(by_name)) {
    const Vec3 distances = distances_of_pairs(places, by_name);
    const auto index = static_cast<Eigen::Index>(wanted.value_or(0));
    if (wanted && distances[index] > 0 && lie_opposite(places, by_name, *wanted)) return *wanted;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (distances[static_cast<Eigen::Index>(k)] > distances[static_cast<Eigen::Index>(axis)]) {
        axis = k;
      }
    }
    return axis;
  }
  const std::size_t first = wanted.value_or(0);
  std::size_t best = first;
  std::optional<Match> found;
  for (const std::size_t axis : {first, std::size_t{0}, std::size_t{2}, std::size_t{1}}) {
    Match match = match_of(skeleton, places, unit(axis), {}, by_name);
    const bool pairs_more = found && !wanted && match.num_paired > found->num_paired;
    const bool is_better =
        !found || (match.num_paired > 0 && (match.num_lonely < found->num_lonely ||
                                            (match.num_lonely == found->num_lonely && pairs_more)));
    if (!is_better) continue;
    best = axis;
    found = std::move(match);
  }
  return best;
}

/// The horizontal direction between named halves, from right to left; nothing if they show none.
std::optional<Vec3> direction_between(const JointPlaces& places, const Skeleton& skeleton,
                                      const std::vector<std::size_t>& by_name, std::size_t up) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t j = 0; j < by_name.size(); ++j) {
    if (by_name[j] == kNoParent) continue;
    const bool is_left = is_left_of(skeleton.joints[j].name, skeleton.joints[by_name[j]].name);
    if (is_left) sum += places.joints[j] - places.joints[by_name[j]];
  }
  sum[static_cast<Eigen::Index>(up)] = 0;
  if (!(sum.norm() > 0)) return std::nullopt;
  return sum.normalized();
}

/// Without names: siblings with equally many joints below them, which may be halves.
std::vector<std::array<std::size_t, 2>> possible_halves(const Skeleton& skeleton) {
  constexpr std::size_t kMost = 10;
  const auto sizes = subtree_sizes(skeleton);
  std::vector<std::array<std::size_t, 2>> halves;
  for (const std::vector<std::size_t>& siblings : children_of_joints(skeleton)) {
    for (std::size_t i = 0; i + 1 < siblings.size() && halves.size() < kMost; ++i) {
      for (std::size_t k = i + 1; k < siblings.size() && halves.size() < kMost; ++k) {
        if (sizes[siblings[i]] == sizes[siblings[k]]) halves.push_back({siblings[i], siblings[k]});
      }
    }
  }
  return halves;
}

/// The horizontal directions between possible halves, and the horizontal axes.
std::vector<Vec3> possible_directions(const JointPlaces& places,
                                      const std::vector<std::array<std::size_t, 2>>& halves,
                                      std::size_t up) {
  std::vector<Vec3> directions = {unit(up == 0 ? 1 : 0), unit(up == 2 ? 1 : 2)};
  for (const auto& [a, b] : halves) {
    Vec3 apart = places.ends[a] - places.ends[b];
    apart[static_cast<Eigen::Index>(up)] = 0;
    if (apart.norm() > 0) directions.push_back(apart.normalized());
  }
  return directions;
}

/// How many frames are tried: each compares all joints with each other.
std::size_t num_tried(std::size_t num_frames, std::size_t num_joints) {
  constexpr std::size_t kMostComparisons = 500000;
  const std::size_t in_one = num_joints * num_joints + 1;
  return std::min(num_frames, std::max<std::size_t>(kMostComparisons / in_one, 1));
}

/// An axis if a direction is that axis up to rounding, so that reflections change signs alone.
Vec3 snapped(const Vec3& direction) {
  constexpr double kRounding = 1e-9;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double along = direction[static_cast<Eigen::Index>(axis)];
    if (std::abs(along) > 1 - kRounding) return unit(axis);
  }
  return direction;
}

struct FrameMatch {
  Match match;
  std::size_t frame = 0;
};

/// The most symmetric of 64 frames.
std::optional<FrameMatch> match_in_frames(const Motion& motion, std::size_t up,
                                          const std::vector<std::size_t>& by_name) {
  const Skeleton& skeleton = motion.skeleton;
  if (motion.clip.num_frames == 0) return std::nullopt;
  const WorldPoses poses = sampled_poses(motion);
  const auto on_trunk = pairs_on_trunk(skeleton, by_name);
  std::optional<FrameMatch> best;
  const auto halves = possible_halves(skeleton);
  const double size = rest_size(skeleton);
  const std::size_t count = num_tried(poses.num_frames, skeleton.joints.size());
  for (std::size_t row = 0; row < count; ++row) {
    const JointPlaces places = places_of(skeleton, size, poses, row);
    std::vector<Vec3> directions;
    if (!has_pairs(by_name)) {
      directions = possible_directions(places, halves, up);
    } else if (const auto direction = direction_between(places, skeleton, on_trunk, up)) {
      directions = {*direction};
    }
    for (const Vec3& direction : directions) {
      Match match = match_of(skeleton, places, snapped(direction), kNearInFrames, by_name);
      const bool is_better =
          !best || match.num_lonely < best->match.num_lonely ||
          (match.num_lonely == best->match.num_lonely && match.asymmetry < best->match.asymmetry);
      const std::size_t frame = row * poses.frame_step;
      if (is_better && std::isfinite(match.asymmetry)) best = FrameMatch{std::move(match), frame};
    }
  }
  return best;
}

/// The horizontal axis along which the halves lie in the frames; the first one unless the other is
/// clearly it.
std::size_t world_axis_of(const Motion& motion, const std::vector<std::size_t>& pairs,
                          std::size_t first, std::size_t up) {
  constexpr double kClearly = 2;
  if (first == up) first = up == 0 ? 1 : 0;
  const std::size_t other = 3 - up - first;
  if (motion.clip.num_frames == 0) return first;
  const auto on_trunk = pairs_on_trunk(motion.skeleton, pairs);
  const WorldPoses poses = sampled_poses(motion);
  const double size = rest_size(motion.skeleton);
  Vec3 distances = Vec3::Zero();
  for (std::size_t row = 0; row < poses.num_frames; ++row) {
    const Vec3 in_row = distances_of_pairs(places_of(motion.skeleton, size, poses, row), on_trunk);
    if (in_row.allFinite()) distances += in_row;
  }
  const double along = distances[static_cast<Eigen::Index>(first)];
  return distances[static_cast<Eigen::Index>(other)] > kClearly * along ? other : first;
}

}  // namespace

Result<MirrorPlane> find_mirror_plane(const Motion& motion, std::optional<std::size_t> axis,
                                      Diagnostics& diagnostics) {
  const Skeleton& skeleton = motion.skeleton;
  // Only the choice of an axis relies on which one points up.
  const UpAxis up = axis ? find_up_axis(motion) : settle_up_axis(motion, diagnostics);
  if (axis == up.axis && up.certainty != Certainty::Doubtful) {
    return fail(ErrorKind::Usage, "EDT004",
                fmt::format("a mirror whose normal is {}, which points up, puts the figure on its "
                            "head; expected one that stands",
                            "xyz"[*axis]));
  }
  const auto by_name = pairs_by_name(skeleton);
  const JointPlaces places = rest_places(skeleton);
  const std::size_t rest_axis = axis_at_rest(skeleton, places, axis, by_name);
  Match match = match_of(skeleton, places, unit(rest_axis), {}, by_name);
  MirrorPlane plane;
  plane.is_symmetric = lie_opposite(places, match.pairs, rest_axis);
  const bool moves = std::any_of(skeleton.joints.begin(), skeleton.joints.end(),
                                 [](const Joint& joint) { return !joint.dofs.empty(); });
  const bool is_good = !moves || (plane.is_symmetric && match.asymmetry <= kSymmetric &&
                                  (match.num_lonely == 0 || has_pairs(by_name)));
  if (!is_good) {
    auto better = match_in_frames(motion, up.axis, by_name);
    const bool pairs_more = better && better->match.num_lonely < match.num_lonely;
    const bool is_nearer = better && better->match.num_lonely == match.num_lonely &&
                           better->match.asymmetry < std::min(kSymmetric, match.asymmetry / 2);
    if (is_nearer || (pairs_more && better->match.asymmetry < kSymmetric)) {
      plane.frame = better->frame;
      plane.is_symmetric = true;
      match = std::move(better->match);
      diagnostics.add(Severity::Note, "EDT012",
                      fmt::format("the rest pose is not symmetric; left and right are matched in "
                                  "frame {}, the most symmetric one, where they differ by up to "
                                  "{:.2g} % of the skeleton's size",
                                  *plane.frame, 100 * match.asymmetry));
    }
  }
  if (match.num_paired > 0 && match.asymmetry > kSymmetric) {
    diagnostics.add(
        Severity::Warning, "EDT015",
        fmt::format("left and right differ by up to {:.2g} % of the skeleton's size, at "
                    "rest and in every frame; the mirrored motion is off by as much",
                    100 * match.asymmetry));
  }
  plane.skeleton_normal = match.normal;
  plane.pairs = std::move(match.pairs);
  pair_with_themselves(skeleton, plane.pairs);
  const std::size_t first = plane.frame ? (up.axis == 0 ? 1 : 0) : rest_axis;
  plane.world_axis = axis ? *axis : world_axis_of(motion, plane.pairs, first, up.axis);
  return plane;
}

}  // namespace kinefile::edit
