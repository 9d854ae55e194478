// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "kinefile/bridge.hpp"
#include "kinefile/joint_rotation.hpp"

namespace kinefile {
namespace {

std::string lowered(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

void warn(Diagnostics& diagnostics, std::string message) {
  Diagnostic warning;
  warning.severity = Severity::Warning;
  warning.code = "BRG006";
  warning.message = std::move(message);
  diagnostics.add(std::move(warning));
}

/// A joint of one skeleton and that of the other by the same name. Roots belong together.
struct Match {
  std::size_t from = 0;
  std::size_t to = 0;
};

std::vector<Match> match_joints(const Skeleton& from, const Skeleton& to) {
  std::map<std::string, std::size_t> index_of_name;
  for (std::size_t j = 0; j < to.joints.size(); ++j) {
    index_of_name.try_emplace(lowered(to.joints[j].name), j);
  }
  std::vector<Match> matches;
  for (std::size_t j = 0; j < from.joints.size(); ++j) {
    const auto found = index_of_name.find(lowered(from.joints[j].name));
    if (found != index_of_name.end()) {
      matches.push_back({j, found->second});
    } else if (from.joints[j].parent == kNoParent) {
      matches.push_back({j, 0});
    }
  }
  return matches;
}

/// The translation that a joint's degrees of freedom make in a row, rest values taken off.
Vec3 translation_in_row(const Joint& joint, std::span<const double> row) {
  Vec3 sum = Vec3::Zero();
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind == DofKind::Translation) sum += row[dof.coordinate] * dof.axis;
  }
  return sum + joint.rest_rotation.conjugate() * joint.offset;
}

/// Moves one matched joint, frame by frame.
/// \returns  the largest angle by which the rotation could not be made, in radians
double move_joint(const Motion& from, const Match& match, double scale, Motion& result) {
  const Joint& source = from.skeleton.joints[match.from];
  const Joint& target = result.skeleton.joints[match.to];
  const auto source_rotations = rotations_of(source);
  const auto target_rotations = rotations_of(target);
  double largest = 0;
  for (std::size_t f = 0; f < from.clip.num_frames; ++f) {
    const auto row = result.clip.row(f);
    if (f > 0) {  // near the frame before
      const auto before = result.clip.row(f - 1);
      for (const DegreeOfFreedom& dof : target_rotations) {
        row[dof.coordinate] = before[dof.coordinate];
      }
    }
    const Mat3 rotation =
        rotation_in_row(source_rotations, from.clip.row(f), from.skeleton.angle_unit);
    if (!rotation.allFinite()) {
      for (const DegreeOfFreedom& dof : target_rotations) row[dof.coordinate] = std::nan("");
      continue;
    }
    largest = std::max(largest,
                       fit_rotation(target_rotations, rotation, result.skeleton.angle_unit, row));
    if (source.parent != kNoParent || target.parent != kNoParent) continue;
    const Vec3 position = source.rest_rotation * translation_in_row(source, from.clip.row(f));
    const Vec3 moved = target.rest_rotation.conjugate() * (scale * position - target.offset);
    for (const DegreeOfFreedom& dof : target.dofs) {
      if (dof.kind == DofKind::Translation) row[dof.coordinate] = dof.axis.dot(moved);
    }
  }
  return largest;
}

bool moves_freely(const Skeleton& skeleton) {
  return std::any_of(skeleton.joints.begin(), skeleton.joints.end(), [](const Joint& joint) {
    return !joint.dofs.empty() && joint.dofs.front().kind == DofKind::Free;
  });
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(names.size(), 5); ++i) {
    text += fmt::format("{}'{}'", i == 0 ? "" : ", ", names[i]);
  }
  return names.size() > 5 ? text + fmt::format(" and {} more", names.size() - 5) : text;
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
    result.clip.values.insert(result.clip.values.end(), rest.begin(), rest.end());
  }
  const double from_unit = motion.skeleton.metres_per_unit;
  const double scale =
      from_unit > 0 && skeleton.metres_per_unit > 0 ? from_unit / skeleton.metres_per_unit : 1.0;
  constexpr double kNoticeable = 1e-6;
  for (const Match& match : matches) {
    const double left = move_joint(*aligned, match, scale, result);
    if (left < kNoticeable) continue;
    warn(diagnostics, fmt::format("joint '{}' cannot turn as it did: up to {:.3g} degrees are left "
                                  "out",
                                  skeleton.joints[match.to].name, left / kRadiansPerDegree));
  }
  tell_unmatched(motion, skeleton, matches, diagnostics);
  return result;
}

}  // namespace kinefile
