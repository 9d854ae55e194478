// SPDX-License-Identifier: MIT
#include "kinefile/limits.hpp"

#include <algorithm>
#include <cmath>

namespace kinefile {
namespace {

/// A value may exceed its limit by this fraction of it, or by this much where the limit is near 0,
/// because of rounding.
constexpr double kTolerance = 1e-9;

bool is_beyond(double limit, double excess) {
  return excess > kTolerance * std::max(std::abs(limit), 1.0);
}

/// Records a frame that is beyond a limit.
void count(LimitBreach& breach, std::size_t frame, double value, double excess, double& worst) {
  if (!is_beyond(breach.limit, excess)) return;
  if (breach.num_frames == 0) breach.first_frame = frame;
  ++breach.num_frames;
  if (!(excess > worst)) return;
  worst = excess;
  breach.worst = value;
  breach.worst_frame = frame;
}

void find_breaches(const Motion& motion, std::size_t joint, std::size_t dof_index,
                   std::vector<LimitBreach>& breaches) {
  using Kind = LimitBreach::Kind;
  const DegreeOfFreedom& dof = motion.skeleton.joints[joint].dofs[dof_index];
  LimitBreach below{Kind::Below, joint, dof_index, 0, 0, 0, 0, dof.lower};
  LimitBreach above{Kind::Above, joint, dof_index, 0, 0, 0, 0, dof.upper};
  LimitBreach fast{Kind::TooFast, joint, dof_index, 0, 0, 0, 0, dof.max_speed};
  double worst_below = 0, worst_above = 0, worst_fast = 0;
  for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
    const double value = value_of(dof, motion.clip.row(f)[dof.coordinate]);
    count(below, f, value, dof.lower - value, worst_below);
    count(above, f, value, value - dof.upper, worst_above);
    if (f == 0) continue;
    const double way = value - value_of(dof, motion.clip.row(f - 1)[dof.coordinate]);
    const double time =
        time_of_frame(motion.clip.timeline, f) - time_of_frame(motion.clip.timeline, f - 1);
    const double speed = std::abs(way) / time;
    if (std::isfinite(speed)) count(fast, f, speed, speed - dof.max_speed, worst_fast);
  }
  for (const LimitBreach& breach : {below, above, fast}) {
    if (breach.num_frames > 0) breaches.push_back(breach);
  }
}

}  // namespace

std::optional<LimitBreach::Kind> breach_of(const DegreeOfFreedom& dof, double value) {
  if (is_beyond(dof.lower, dof.lower - value)) return LimitBreach::Kind::Below;
  if (is_beyond(dof.upper, value - dof.upper)) return LimitBreach::Kind::Above;
  return std::nullopt;
}

ToldUnit told_unit(const DegreeOfFreedom& dof, const Skeleton& skeleton) {
  if (dof.kind == DofKind::Rotation) {
    return {radians_per(skeleton.angle_unit) / kRadiansPerDegree, "deg"};
  }
  if (dof.kind == DofKind::TailScale) return {1, ""};
  if (skeleton.metres_per_unit > 0) return {skeleton.metres_per_unit, "m"};
  return {1, "units"};
}

std::vector<LimitBreach> find_limit_breaches(const Motion& motion) {
  std::vector<LimitBreach> breaches;
  for (std::size_t j = 0; j < motion.skeleton.joints.size(); ++j) {
    const std::vector<DegreeOfFreedom>& dofs = motion.skeleton.joints[j].dofs;
    for (std::size_t d = 0; d < dofs.size(); ++d) {
      if (num_coordinates(dofs[d]) == 1) find_breaches(motion, j, d, breaches);
    }
  }
  return breaches;
}

}  // namespace kinefile
