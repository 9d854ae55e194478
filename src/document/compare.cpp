// SPDX-License-Identifier: MIT
#include "document/compare.hpp"

#include "kinefile/kinematics.hpp"

namespace kinefile {
namespace {

/// The motion of a document; for a skeleton alone, one frame of its rest pose.
Motion motion_or_rest(const Document& document) {
  Motion motion = still_or_moving(document);
  if (std::holds_alternative<Skeleton>(document.content)) motion.clip = rest_clip(motion.skeleton);
  return motion;
}

bool differs(const MotionComparison& comparison, double tolerance) {
  return comparison.distance.value > tolerance || comparison.tip_distance.value > tolerance ||
         !comparison.only_in_first.empty() || !comparison.only_in_second.empty() ||
         comparison.num_frames_first != comparison.num_frames_second;
}

}  // namespace

Result<Comparison> compare(const Document& first, const Document& second,
                           const CompareOptions& options) {
  const BodyMotion* body_a = std::get_if<BodyMotion>(&first.content);
  const BodyMotion* body_b = std::get_if<BodyMotion>(&second.content);
  if (body_a != nullptr && body_b != nullptr) {
    return compare_components(*body_a, *body_b, options.tolerance);
  }
  const PoseFlow* flow_a = std::get_if<PoseFlow>(&first.content);
  const PoseFlow* flow_b = std::get_if<PoseFlow>(&second.content);
  if (flow_a != nullptr && flow_b != nullptr) return compare_flows(*flow_a, *flow_b);
  if (!has_skeleton(first) || !has_skeleton(second)) {
    return fail(ErrorKind::Usage, "CLI001",
                "diff compares two motions, two body motions or two flows; convert one first");
  }
  MotionComparison found = compare_motions(motion_or_rest(first), motion_or_rest(second));
  const bool is_different = differs(found, options.tolerance);
  return Comparison{std::move(found), is_different};
}

}  // namespace kinefile
