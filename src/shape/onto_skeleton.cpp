// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/words.hpp"
#include "kinefile/joint_rotation.hpp"
#include "kinefile/shape.hpp"
#include "kinematics/rotation_batches.hpp"

namespace kinefile::shape {
namespace {

void warn(Diagnostics& diagnostics, std::string message) {
  diagnostics.add(Severity::Warning, "BRG006", std::move(message));
}

/// A joint of one skeleton and that of the other by the same name. Roots belong together.
struct Match {
  std::size_t from = 0;
  std::size_t to = 0;
};

std::vector<Match> match_joints(const Skeleton& from, const Skeleton& to) {
  std::map<std::string, std::size_t> index_of_name;
  for (std::size_t j = 0; j < to.joints.size(); ++j) {
    if (to.joints[j].parent != kNoParent) index_of_name.try_emplace(lowered(to.joints[j].name), j);
  }
  std::vector<Match> matches;
  bool has_root = false;
  for (std::size_t j = 0; j < from.joints.size(); ++j) {
    const bool is_root = from.joints[j].parent == kNoParent;
    const auto found = index_of_name.find(lowered(from.joints[j].name));
    if (is_root && !std::exchange(has_root, true) && !to.joints.empty()) {
      matches.push_back({j, 0});
    } else if (found != index_of_name.end()) {
      matches.push_back({j, found->second});
    }
  }
  // The roots alone make no match, unless there is nothing else.
  const bool is_real = matches.size() > 1 || from.joints.size() == 1 || to.joints.size() == 1;
  return is_real ? matches : std::vector<Match>{};
}

/// What one joint could not do as the other did.
struct Residue {
  double angle = 0;     ///< the largest, in radians
  double distance = 0;  ///< the largest, in the unit of the other skeleton
};

/// Where a root is in the world, or how far another joint is from its rest position, in its
/// parent's frame.
Vec3 movement_in_row(const Joint& joint, std::span<const double> row) {
  const bool is_root = joint.parent == kNoParent;
  Vec3 sum = Vec3::Zero();
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind != DofKind::Translation) continue;
    sum += (row[dof.coordinate] - (is_root ? 0 : dof.rest)) * dof.axis;
  }
  return joint.rest_rotation * sum + (is_root ? joint.offset : Vec3(Vec3::Zero()));
}

/// Brings a movement back to the translations of a joint.
/// \returns  how much of it is left
double fit_movement(const Joint& joint, const Vec3& movement, std::span<double> row) {
  const bool is_root = joint.parent == kNoParent;
  Vec3 left = joint.rest_rotation.conjugate() * (is_root ? movement - joint.offset : movement);
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind != DofKind::Translation) continue;
    const double along = dof.axis.dot(left);
    row[dof.coordinate] = along + (is_root ? 0 : dof.rest);
    left -= along * dof.axis;
  }
  return left.norm();
}

/// Moves one matched joint.
Residue move_joint(const Motion& from, const Match& match, double scale, Motion& result) {
  const Joint& source = from.skeleton.joints[match.from];
  const Joint& target = result.skeleton.joints[match.to];
  const Rows rows = result.clip.mutate();
  Residue residue;
  for (std::size_t f = 0; f < from.clip.num_frames; ++f) {
    const Vec3 movement = scale * movement_in_row(source, from.clip.row(f));
    residue.distance = std::max(residue.distance, fit_movement(target, movement, rows[f]));
  }
  const auto rotations = rotations_of(source);
  RotationFitter fitter(rotations_of(target), result.skeleton.angle_unit,
                        rest_coordinates(result.skeleton));
  simd::Quaternions found;
  for (const FrameRange& frames : batches_of(from.clip.num_frames)) {
    rotations_in_rows(rotations, from.clip, frames, from.skeleton.angle_unit, found);
    residue.angle = std::max(residue.angle, fitter.fit(found, frames, rows));
  }
  return residue;
}

bool moves_freely(const Skeleton& skeleton) {
  return std::any_of(skeleton.joints.begin(), skeleton.joints.end(),
                     [](const Joint& joint) { return kinefile::moves_freely(joint); });
}

void tell_unmatched(const Motion& motion, const Skeleton& skeleton,
                    const std::vector<Match>& matches, Diagnostics& diagnostics) {
  std::vector<bool> is_used(motion.skeleton.joints.size(), false);
  std::vector<bool> is_moved(skeleton.joints.size(), false);
  for (const Match& match : matches) {
    is_used[match.from] = true;
    is_moved[match.to] = true;
  }
  std::vector<std::string> left_out;
  std::vector<std::string> at_rest;
  for (std::size_t j = 0; j < is_used.size(); ++j) {
    const Joint& joint = motion.skeleton.joints[j];
    if (!is_used[j] && !joint.dofs.empty()) left_out.push_back(joint.name);
  }
  for (std::size_t j = 0; j < is_moved.size(); ++j) {
    if (!is_moved[j] && !skeleton.joints[j].dofs.empty())
      at_rest.push_back(skeleton.joints[j].name);
  }
  if (!left_out.empty()) {
    warn(diagnostics,
         "joints that the other skeleton does not have are left out: " + listed(left_out));
  }
  if (!at_rest.empty()) {
    warn(diagnostics, "joints that only the other skeleton has rest: " + listed(at_rest));
  }
}

}  // namespace

Result<Motion> onto_skeleton(const Motion& motion, const Skeleton& skeleton,
                             Diagnostics& diagnostics) {
  const std::vector<Match> matches = match_joints(motion.skeleton, skeleton);
  if (matches.empty() || moves_freely(motion.skeleton) || moves_freely(skeleton)) {
    return fail(make_error(ErrorKind::Usage, "BRG004",
                           matches.empty() ? "no joint of the motion has the name of one of the "
                                             "skeleton"
                                           : "a joint moves freely, which this cannot bring over"));
  }
  auto aligned = with_world_aligned_rest(motion);
  if (!aligned) return fail(std::move(aligned.error()));
  Motion result;
  result.skeleton = skeleton;
  result.clip.timeline = motion.clip.timeline;
  result.clip.num_frames = motion.clip.num_frames;
  result.clip.num_coordinates = skeleton.coordinates.size();
  const std::vector<double> rest = rest_coordinates(skeleton);
  for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
    result.clip.values.append(rest);
  }
  const double from_unit = motion.skeleton.metres_per_unit;
  const bool has_units = from_unit > 0 && skeleton.metres_per_unit > 0;
  if (!has_units) {
    warn(diagnostics,
         "a file does not say its unit of length, so positions are taken over as they "
         "are (--unit-in says it)");
  }
  const double scale = has_units ? from_unit / skeleton.metres_per_unit : 1.0;
  constexpr double kNoticeable = 1e-6;
  for (const Match& match : matches) {
    const Residue left = move_joint(*aligned, match, scale, result);
    const std::string& name = skeleton.joints[match.to].name;
    if (left.angle > kNoticeable) {
      warn(diagnostics, fmt::format("joint '{}' cannot turn as it did: up to {:.3g} degrees are "
                                    "left out",
                                    name, left.angle / kRadiansPerDegree));
    }
    if (left.distance > kNoticeable) {
      warn(diagnostics, fmt::format("joint '{}' cannot move as it did: up to {:.3g} units of "
                                    "length are left out",
                                    name, left.distance));
    }
  }
  tell_unmatched(motion, skeleton, matches, diagnostics);
  return result;
}

}  // namespace kinefile::shape
