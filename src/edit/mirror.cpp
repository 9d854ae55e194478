// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "base/parallel.hpp"
#include "edit/mirror_plan.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/joint_rotation.hpp"
#include "kinefile/kinematics.hpp"
#include "kinematics/joint_columns.hpp"
#include "kinematics/rotation_batches.hpp"

namespace kinefile::edit {
namespace {

constexpr double kReached = 1e-6;  // the largest residual, in radians or of the skeleton's size

/// Fails, or only warns if lenient.
Result<void> fail_or_warn(const MirrorContext& context, std::string message) {
  Error error = make_error(ErrorKind::Usage, "EDT004", std::move(message));
  if (!context.lenient) return fail(std::move(error));
  error.severity = Severity::Warning;
  error.message += "; it is mirrored as it can";
  context.diagnostics.add(std::move(error));
  return {};
}

/// Mirrors a whole rotation in its numbers, which keep their bits: its vector part is mirrored.
void mirror_numbers(const JointPlan& plan, const DegreeOfFreedom& from, const DegreeOfFreedom& to,
                    std::span<const double> row, std::span<double> result) {
  const std::size_t num_before = num_coordinates(from) - 3;  // qw
  const Vec3 old_vector(&row[from.coordinate + num_before]);
  const Vec3 new_vector = -reflect(plan.frame.transpose(), old_vector);
  std::copy_n(&row[from.coordinate], num_before, &result[to.coordinate]);
  std::copy_n(new_vector.data(), 3, &result[to.coordinate + num_before]);
}

/// The wanted rotations of a plan's target in some frames.
void mirrored_rotations(const MirrorContext& context, const JointPlan& plan,
                        const RotationReader& reader, const FrameBatch& frames,
                        simd::Quaternions& out) {
  reader.read(context.motion.clip, frames, out);
  if (plan.is_conjugate) {
    rotation::turn_axes(-plan.frame.transpose(), out);
    return;
  }
  for (std::size_t i = 0; i < frames.count; ++i) {
    const Quat turned = plan.before * rotation::quaternion_at(out, i) * plan.after;
    rotation::put_quaternion(turned, i, out);
  }
}

/// Which of a target's degrees of freedom follow another joint.
std::vector<bool> follows_of(const MirrorContext& context, const JointPlan& plan,
                             const std::vector<DegreeOfFreedom>& dofs) {
  return following_dofs(dofs, plan.target, context.leaders);
}

std::vector<bool> follows_of(const MirrorContext& context, const JointPlan& plan,
                             const std::vector<Translation>& translations) {
  std::vector<DegreeOfFreedom> dofs;
  for (const Translation& translation : translations) dofs.push_back(translation.dof);
  return follows_of(context, plan, dofs);
}

/// How the rotation of a plan's target is found.
struct RotationPlan {
  std::vector<DegreeOfFreedom> from;
  std::vector<DegreeOfFreedom> to;
  bool is_exact = false;  ///< see `mirror_numbers`
  RotationReader reader;
  RotationFitter fitter;
};

RotationPlan plan_rotation(const MirrorContext& context, const JointPlan& plan) {
  const Skeleton& skeleton = context.motion.skeleton;
  const auto from = rotations_of(skeleton.joints[plan.source]);
  const auto to = rotations_of(skeleton.joints[plan.target]);
  const auto follows = follows_of(context, plan, to);
  const bool is_exact = plan.is_conjugate && is_whole_rotation(from) && is_whole_rotation(to) &&
                        from[0].kind == to[0].kind && !follows[0];
  return {from, to, is_exact, RotationReader(from, skeleton.angle_unit),
          RotationFitter(to, skeleton.angle_unit, context.rest, follows)};
}

/// Finds the rotation of a joint in some frames, those after the last ones.
/// \param found  memory
/// \returns      the largest residual angle, in radians
double find_rotations(const MirrorContext& context, const JointPlan& plan, const FrameBatch& frames,
                      const Rows& rows, RotationPlan& rotation, simd::Quaternions& found) {
  if (!rotation.is_exact) {
    mirrored_rotations(context, plan, rotation.reader, frames, found);
    return rotation.fitter.fit(found, frames, rows);
  }
  for (std::size_t f = frames.first; f < frames.first + frames.count; ++f) {
    mirror_numbers(plan, rotation.from[0], rotation.to[0], context.motion.clip.row(f), rows[f]);
  }
  return 0;
}

/// Finds the position of a joint in some frames.
/// \returns the largest residual distance
double find_positions(const MirrorContext& context, const JointPlan& plan, const FrameBatch& frames,
                      const Rows& rows) {
  const Joint& source = context.motion.skeleton.joints[plan.source];
  const Joint& target = context.motion.skeleton.joints[plan.target];
  const auto from = translations_of(source);
  const auto to = translations_of(target);
  if (to.empty()) return 0;
  const auto follows = follows_of(context, plan, to);
  double residual = 0;
  for (std::size_t f = frames.first; f < frames.first + frames.count; ++f) {
    const Vec3 place = position_in_row(source.offset, from, context.motion.clip.row(f));
    residual = std::max(
        residual, fit_position(target.offset, to, reflect(plan.parent, place), rows[f], follows));
  }
  return residual;
}

Result<void> report_joint(const MirrorContext& context, const JointPlan& plan) {
  const std::vector<Joint>& joints = context.motion.skeleton.joints;
  return fail_or_warn(context, fmt::format("joint '{}' cannot move as '{}' does in the mirror",
                                           joints[plan.target].name, joints[plan.source].name));
}

/// Copies a column with its sign in some frames.
void copy_column(const Copy& copy, const Clip& clip, const FrameBatch& frames, const Rows& rows) {
  const double* const from =
      clip.values.data() + frames.first * clip.num_coordinates + copy.from.coordinate;
  double* const to = rows.values.data() + frames.first * rows.width + copy.to.coordinate;
  const std::size_t stride = rows.width;
  if (keeps_numbers(copy.from, copy.to, copy.sign)) {
    const double sign = copy.sign;
    for (std::size_t i = 0; i < frames.count; ++i) to[i * stride] = sign * from[i * stride];
  } else {
    for (std::size_t i = 0; i < frames.count; ++i) {
      to[i * stride] = carried_over(copy.from, copy.to, copy.sign, from[i * stride]);
    }
  }
}

/// Copies the columns that no plan copies to: what is found is near to their numbers, or they stay.
void keep_columns(const MirrorContext& context, const std::vector<JointPlan>& plans,
                  const Rows& rows) {
  std::vector<bool> is_copied(rows.width, false);
  for (const JointPlan& plan : plans) {
    for (const Copy& copy : plan.copies) is_copied[copy.to.coordinate] = true;
  }
  std::vector<Copy> kept;
  for (std::size_t c = 0; c < rows.width; ++c) {
    const DegreeOfFreedom same{DofKind::Translation, Vec3::UnitX(), c, 0};
    if (!is_copied[c]) kept.push_back({same, same, 1});
  }
  for_each_group(kept.size(), rows.values.size(), [&](std::size_t begin, std::size_t end) {
    for (const FrameBatch& frames : batches_of(context.motion.clip.num_frames)) {
      for (std::size_t k = begin; k < end; ++k) {
        copy_column(kept[k], context.motion.clip, frames, rows);
      }
    }
  });
}

/// What the numbers that were found miss.
struct Residual {
  double distance = 0;
  double angle = 0;
};

/// Mirrors the motion of some joints, a batch of frames after the other.
void mirror_joints(const MirrorContext& context, std::span<const JointPlan> plans, const Rows& rows,
                   std::span<Residual> residuals) {
  std::vector<std::optional<RotationPlan>> rotations(plans.size());
  for (std::size_t n = 0; n < plans.size(); ++n) {
    if (plans[n].is_rotation_found) rotations[n] = plan_rotation(context, plans[n]);
  }
  simd::Quaternions found;
  for (const FrameBatch& frames : batches_of(context.motion.clip.num_frames)) {
    for (std::size_t n = 0; n < plans.size(); ++n) {
      const JointPlan& plan = plans[n];
      for (const Copy& copy : plan.copies) copy_column(copy, context.motion.clip, frames, rows);
      if (plan.is_position_found) {
        residuals[n].distance =
            std::max(residuals[n].distance, find_positions(context, plan, frames, rows));
      }
      if (plan.is_rotation_found) {
        residuals[n].angle = std::max(
            residuals[n].angle, find_rotations(context, plan, frames, rows, *rotations[n], found));
      }
    }
  }
}

/// Mirrors the motion of all joints.
std::vector<Residual> mirror_all(const MirrorContext& context, const std::vector<JointPlan>& plans,
                                 const Rows& rows) {
  std::vector<Residual> residuals(plans.size());
  const std::span<const JointPlan> all = plans;
  const std::span<Residual> missed = residuals;
  const auto num_alone = static_cast<std::size_t>(
      std::count_if(plans.begin(), plans.end(), [](const JointPlan& p) { return p.is_alone; }));
  for_each_group(num_alone, rows.values.size(), [&](std::size_t begin, std::size_t end) {
    mirror_joints(context, all.subspan(begin, end - begin), rows, missed.subspan(begin));
  });
  mirror_joints(context, all.subspan(num_alone), rows, missed.subspan(num_alone));
  return residuals;
}

/// Reports joints without a partner, and those that cannot move as theirs do, in their order.
Result<void> report_joints(const MirrorContext& context, const std::vector<JointPlan>& plans,
                           const std::vector<Residual>& residuals) {
  const std::vector<Joint>& joints = context.motion.skeleton.joints;
  std::vector<std::size_t> order(plans.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&plans](std::size_t a, std::size_t b) { return plans[a].source < plans[b].source; });
  for (const std::size_t n : order) {
    const JointPlan& plan = plans[n];
    if (!plan.has_partner) {
      auto reported = fail_or_warn(
          context, fmt::format("joint '{}' has no other half, by name or by where it lies, and "
                               "does not lie in the plane of the mirror",
                               joints[plan.source].name));
      if (!reported) return reported;
    }
    const bool is_out_of_reach =
        residuals[n].distance > kReached * context.size || residuals[n].angle > kReached;
    // If a joint follows others, these may not have been moved yet.
    const bool is_lost = is_position_lost(joints[plan.source], joints[plan.target]);
    if ((!is_out_of_reach || plan.follows) && !is_lost) continue;
    if (auto reported = report_joint(context, plan); !reported) return reported;
  }
  return {};
}

/// Whether a joint that follows others has the mirrored pose.
bool is_reached(const MirrorContext& context, const JointPlan& plan, const Clip& result) {
  const Skeleton& skeleton = context.motion.skeleton;
  const Joint& source = skeleton.joints[plan.source];
  const Joint& target = skeleton.joints[plan.target];
  const auto from = translations_of(source);
  const auto to = translations_of(target);
  const auto rotations = rotations_of(target);
  const RotationReader reader(rotations_of(source), skeleton.angle_unit);
  simd::Quaternions wanted;
  for (const FrameBatch& frames : batches_of(result.num_frames)) {
    mirrored_rotations(context, plan, reader, frames, wanted);
    for (std::size_t i = 0; i < frames.count; ++i) {
      const std::size_t f = frames.first + i;
      const Vec3 place = position_in_row(source.offset, from, context.motion.clip.row(f));
      const Vec3 apart =
          position_in_row(target.offset, to, result.row(f)) - reflect(plan.parent, place);
      const Quat turned = quaternion_in_row(rotations, result.row(f), skeleton.angle_unit);
      const double angle = angle_between(rotation::quaternion_at(wanted, i), turned);
      const bool is_away = !to.empty() && apart.norm() > kReached * context.size;
      if (is_away || (!rotations.empty() && angle > kReached)) return false;
    }
  }
  return true;
}

}  // namespace

Result<Motion> mirror(const Motion& motion, std::optional<std::size_t> axis, bool lenient,
                      Diagnostics& diagnostics) {
  const Skeleton& skeleton = motion.skeleton;
  if (skeleton.joints.empty()) return motion;
  const auto plane = find_mirror_plane(motion, axis, diagnostics);
  if (!plane) return fail(plane.error());
  const MirrorContext context = mirror_context(motion, *plane, lenient, diagnostics);
  if (!plane->is_symmetric) {
    auto reported = fail_or_warn(
        context,
        "left and right do not lie on the two sides of a plane, neither at rest nor in a frame");
    if (!reported) return fail(std::move(reported.error()));
  }
  const std::vector<JointPlan> plans = plan_joints(context, plane->pairs);
  Motion result{skeleton, {}};
  result.clip.num_frames = motion.clip.num_frames;
  result.clip.num_coordinates = motion.clip.num_coordinates;
  result.clip.timeline = motion.clip.timeline;
  result.clip.values.resize(motion.clip.values.size());
  const Rows rows = result.clip.mutate();
  keep_columns(context, plans, rows);
  auto reported = report_joints(context, plans, mirror_all(context, plans, rows));
  if (!reported) return fail(std::move(reported.error()));
  for (const JointPlan& plan : plans) {
    if (!plan.follows || is_reached(context, plan, result.clip)) continue;
    auto out_of_reach = report_joint(context, plan);
    if (!out_of_reach) return fail(std::move(out_of_reach.error()));
  }
  return result;
}

}  // namespace kinefile::edit
