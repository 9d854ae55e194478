// SPDX-License-Identifier: MIT
// Mirrored in a plane of the world with S = I - 2 n n^T, joint j with world pose W_j gives its
// partner k the pose W'_k = S W_j M_j. M_j = G_j^-1 T G_k transforms j's frame to k's: G are the
// joints' frames in a pose that is its own image in the skeleton's plane, with mirror T; the pose
// with angles 0, or a frame. In its parent's frame, k's pose is M_p^-1 L_j M_j, where M_p^-1 is S
// for a root. k's degrees of freedom make the part B D_j M_j of it, where B = R_k^-1 M_p^-1 R_j and
// R are rest rotations. In the pose with angles 0, and with S = T, B is M_j^-1: a rotation about a
// becomes the opposite rotation about M_j^-1 a. If no joint has a rest rotation, every M is T.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "edit/mirror_plane.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/joint_rotation.hpp"
#include "kinefile/kinematics.hpp"
#include "kinematics/joint_columns.hpp"
#include "kinematics/rotation_batches.hpp"

namespace kinefile::edit {
namespace {

constexpr double kSamePlace = 1e-9;  // of the skeleton's size
constexpr double kReached = 1e-6;    // the largest residual, in radians or of the skeleton's size

/// A number that is copied from one degree of freedom to another, with the same or the opposite
/// sign.
struct Copy {
  DegreeOfFreedom from;
  DegreeOfFreedom to;
  double sign = 1;
};

/// How the motion of one joint becomes that of its partner.
struct JointPlan {
  std::size_t source = 0;
  std::size_t target = 0;
  Mat3 frame = Mat3::Identity();   ///< M_j: from the target's frame to the source's, mirrored
  Mat3 parent = Mat3::Identity();  ///< M_p^-1: from the source's parent's to the target's parent's
  Quat before = Quat::Identity();  ///< -B
  Quat after = Quat::Identity();   ///< -M_j
  bool is_conjugate = true;        ///< B is M_j^-1
  std::vector<Copy> copies;
  bool follows = false;            ///< the target follows another joint in some column
  bool is_rotation_found = false;  ///< angles are recomputed
  bool is_position_found = false;
};

struct MirrorContext {
  const Motion& motion;
  double size = 0;
  bool lenient = false;
  Diagnostics& diagnostics;
  std::vector<Quat> frames = {};            ///< G: the rotations of joints in the symmetric pose
  std::vector<std::size_t> leaders = {};    ///< of columns
  std::vector<double> rest = {};            ///< of columns
  Mat3 skeleton_mirror = Mat3::Identity();  ///< T
  Mat3 world_mirror = Mat3::Identity();     ///< S
  bool is_at_rest = true;                   ///< the symmetric pose is that with angles 0
};

/// The rotation of every joint's frame in the world if all degrees of freedom are 0.
std::vector<Quat> rest_frames(const Skeleton& skeleton) {
  std::vector<Quat> frames;
  for (const Joint& joint : skeleton.joints) {
    const Quat parent = joint.parent == kNoParent ? Quat(Quat::Identity()) : frames[joint.parent];
    frames.emplace_back(parent * joint.rest_rotation);
  }
  return frames;
}

/// The rotation of every joint's frame in the world in a frame of a motion.
std::vector<Quat> frames_in(const Motion& motion, std::size_t frame) {
  const WorldPoses poses = forward_kinematics(
      motion.skeleton, motion.clip, {.first_frame = frame, .num_frames = 1, .rotations = true});
  std::vector<Quat> frames;
  for (std::size_t j = 0; j < poses.num_joints; ++j) {
    const double* q = &poses.rotations[j * 4];
    frames.emplace_back(q[0], q[1], q[2], q[3]);
  }
  return frames;
}

/// The reflection in a plane through the origin.
Mat3 mirror_of(const Vec3& normal) { return Mat3::Identity() - 2 * normal * normal.transpose(); }

/// A vector times a mirror matrix; exact if that only changes signs.
Vec3 reflect(const Mat3& mirror, const Vec3& v) {
  const Vec3 diagonal = mirror.diagonal();
  if (mirror == Mat3(diagonal.asDiagonal())) return diagonal.cwiseProduct(v);
  return mirror * v;
}

/// +1 if two unit vectors are equal, -1 if they are opposite.
std::optional<double> sign_between(const Vec3& a, const Vec3& b) {
  if ((a - b).norm() <= kSameDirection) return 1;
  if ((a + b).norm() <= kSameDirection) return -1;
  return std::nullopt;
}

std::vector<DegreeOfFreedom> dofs_of_kind(const Joint& joint, DofKind kind) {
  std::vector<DegreeOfFreedom> dofs;
  std::copy_if(joint.dofs.begin(), joint.dofs.end(), std::back_inserter(dofs),
               [kind](const DegreeOfFreedom& dof) { return dof.kind == kind; });
  return dofs;
}

/// Fails, or only warns if lenient.
Result<void> fail_or_warn(const MirrorContext& context, std::string message) {
  Error error = make_error(ErrorKind::Usage, "EDT004", std::move(message));
  if (!context.lenient) return fail(std::move(error));
  error.severity = Severity::Warning;
  error.message += "; it is mirrored as it can";
  context.diagnostics.add(std::move(error));
  return {};
}

/// The copies that mirror the rotations, if the target has the mirror images of their axes.
std::optional<std::vector<Copy>> copies_of_rotations(const JointPlan& plan, const Joint& source,
                                                     const Joint& target) {
  const auto from = rotations_of(source);
  const auto to = rotations_of(target);
  const bool is_whole = is_whole_rotation(from) || is_whole_rotation(to);
  if (!plan.is_conjugate || is_whole || from.size() != to.size()) return std::nullopt;
  std::vector<Copy> copies;
  for (std::size_t k = 0; k < from.size(); ++k) {
    const auto sign = sign_between(to[k].axis, reflect(plan.frame.transpose(), from[k].axis));
    if (!sign) return std::nullopt;
    copies.push_back({from[k], to[k], -*sign});
  }
  return copies;
}

/// The copies that mirror the position, if offsets and axes are each other's mirror images.
std::optional<std::vector<Copy>> copies_of_slides(const JointPlan& plan, const Joint& source,
                                                  const Joint& target, double size) {
  const auto from = translations_of(source);
  const auto to = translations_of(target);
  const Vec3 image = reflect(plan.parent, source.offset);
  if (from.size() != to.size() || !((image - target.offset).norm() <= kSamePlace * size)) {
    return std::nullopt;
  }
  std::vector<Copy> copies;
  for (const Translation& translation : to) {
    for (const Translation& other : from) {
      const auto sign = sign_between(translation.axis, reflect(plan.parent, other.axis));
      if (sign) copies.push_back({other.dof, translation.dof, *sign});
    }
  }
  return copies.size() == to.size() ? std::optional(copies) : std::nullopt;
}

/// The copies of the degrees of freedom of the tail: one for one, in order.
void copy_tails(const JointPlan& plan, const Joint& source, const Joint& target, DofKind kind,
                std::vector<Copy>& copies) {
  const auto from = dofs_of_kind(source, kind);
  const auto to = dofs_of_kind(target, kind);
  for (std::size_t k = 0; k < std::min(from.size(), to.size()); ++k) {
    const bool is_opposite = reflect(plan.frame.transpose(), from[k].axis).dot(to[k].axis) < 0;
    const bool is_negated = is_opposite && kind == DofKind::TailTranslation;
    copies.push_back({from[k], to[k], is_negated ? -1.0 : 1.0});
  }
}

JointPlan plan_joint(const MirrorContext& context, std::size_t source_index,
                     std::size_t target_index) {
  const Skeleton& skeleton = context.motion.skeleton;
  const Joint& source = skeleton.joints[source_index];
  const Joint& target = skeleton.joints[target_index];
  const Mat3& mirror = context.skeleton_mirror;
  const auto frame = [&context](std::size_t joint) {
    return joint == kNoParent ? Mat3(Mat3::Identity()) : context.frames[joint].toRotationMatrix();
  };
  JointPlan plan;
  plan.source = source_index;
  plan.target = target_index;
  const auto follows = following_dofs(target.dofs, target_index, context.leaders);
  plan.follows = std::find(follows.begin(), follows.end(), true) != follows.end();
  const bool is_root = source.parent == kNoParent && target.parent == kNoParent;
  plan.frame = frame(source_index).transpose() * mirror * frame(target_index);
  plan.parent = is_root ? context.world_mirror
                        : Mat3(frame(target.parent).transpose() * mirror * frame(source.parent));
  plan.is_conjugate =
      context.is_at_rest && (!is_root || context.world_mirror == context.skeleton_mirror);
  plan.after = Quat(Mat3(-plan.frame));
  plan.before = Quat(Mat3(-(target.rest_rotation.toRotationMatrix().transpose() * plan.parent *
                            source.rest_rotation.toRotationMatrix())));
  if (auto copies = copies_of_rotations(plan, source, target)) {
    plan.copies = std::move(*copies);
  } else {
    plan.is_rotation_found = true;
  }
  if (auto copies = copies_of_slides(plan, source, target, context.size)) {
    plan.copies.insert(plan.copies.end(), copies->begin(), copies->end());
  } else {
    plan.is_position_found = true;
  }
  copy_tails(plan, source, target, DofKind::TailTranslation, plan.copies);
  copy_tails(plan, source, target, DofKind::TailScale, plan.copies);
  return plan;
}

/// Whether the degrees of freedom of two partners differ so that motion is lost.
bool is_position_lost(const Joint& source, const Joint& target) {
  return translations_of(source).size() > translations_of(target).size() ||
         moves_freely(source) != moves_freely(target) ||
         dofs_of_kind(source, DofKind::TailTranslation).size() !=
             dofs_of_kind(target, DofKind::TailTranslation).size() ||
         dofs_of_kind(source, DofKind::TailScale).size() !=
             dofs_of_kind(target, DofKind::TailScale).size();
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
                        const FrameBatch& frames, simd::Quaternions& out) {
  const auto rotations = rotations_of(context.motion.skeleton.joints[plan.source]);
  rotations_in_rows(rotations, context.motion.clip, frames, context.motion.skeleton.angle_unit,
                    out);
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

/// Finds the rotation of a joint in all frames.
/// \returns the largest residual angle, in radians
double find_rotations(const MirrorContext& context, const JointPlan& plan, const Rows& rows) {
  const Clip& clip = context.motion.clip;
  const Skeleton& skeleton = context.motion.skeleton;
  const auto from = rotations_of(skeleton.joints[plan.source]);
  const auto to = rotations_of(skeleton.joints[plan.target]);
  const auto follows = follows_of(context, plan, to);
  const bool is_exact = plan.is_conjugate && is_whole_rotation(from) && is_whole_rotation(to) &&
                        from[0].kind == to[0].kind && !follows[0];
  if (is_exact) {
    for (std::size_t f = 0; f < clip.num_frames; ++f) {
      mirror_numbers(plan, from[0], to[0], clip.row(f), rows[f]);
    }
    return 0;
  }
  RotationFitter fitter(to, skeleton.angle_unit, context.rest, follows);
  simd::Quaternions found;
  double residual = 0;
  for (const FrameBatch& frames : batches_of(clip.num_frames)) {
    mirrored_rotations(context, plan, frames, found);
    residual = std::max(residual, fitter.fit(found, frames, rows));
  }
  return residual;
}

/// Finds the position of a joint in all frames.
/// \returns the largest residual distance
double find_positions(const MirrorContext& context, const JointPlan& plan, const Rows& rows) {
  const Joint& source = context.motion.skeleton.joints[plan.source];
  const Joint& target = context.motion.skeleton.joints[plan.target];
  const auto from = translations_of(source);
  const auto to = translations_of(target);
  if (to.empty()) return 0;
  const auto follows = follows_of(context, plan, to);
  double residual = 0;
  for (std::size_t f = 0; f < context.motion.clip.num_frames; ++f) {
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

Result<void> mirror_joint(const MirrorContext& context, const JointPlan& plan, const Rows& rows) {
  const Joint& source = context.motion.skeleton.joints[plan.source];
  const Joint& target = context.motion.skeleton.joints[plan.target];
  const Clip& clip = context.motion.clip;
  for (const Copy& copy : plan.copies) {
    if (context.leaders[copy.to.coordinate] != plan.target) continue;
    for (std::size_t f = 0; f < clip.num_frames; ++f) {
      rows[f][copy.to.coordinate] =
          carried_over(copy.from, copy.to, copy.sign, clip.row(f)[copy.from.coordinate]);
    }
  }
  // Both are computed, even if the first residual is too large already.
  const double distance = plan.is_position_found ? find_positions(context, plan, rows) : 0;
  const double angle = plan.is_rotation_found ? find_rotations(context, plan, rows) : 0;
  const bool is_out_of_reach = distance > kReached * context.size || angle > kReached;
  // If a joint follows others, these may not have been moved yet.
  if ((!is_out_of_reach || plan.follows) && !is_position_lost(source, target)) return {};
  return report_joint(context, plan);
}

/// Whether a joint that follows others has the mirrored pose.
bool is_reached(const MirrorContext& context, const JointPlan& plan, const Clip& result) {
  const Skeleton& skeleton = context.motion.skeleton;
  const Joint& source = skeleton.joints[plan.source];
  const Joint& target = skeleton.joints[plan.target];
  const auto from = translations_of(source);
  const auto to = translations_of(target);
  const auto rotations = rotations_of(target);
  simd::Quaternions wanted;
  for (const FrameBatch& frames : batches_of(result.num_frames)) {
    mirrored_rotations(context, plan, frames, wanted);
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
  Motion result = motion;
  if (skeleton.joints.empty()) return result;
  const auto plane = find_mirror_plane(motion, axis, diagnostics);
  if (!plane) return fail(plane.error());
  MirrorContext context{motion, rest_size(skeleton), lenient, diagnostics};
  context.is_at_rest = !plane->frame.has_value();
  context.frames = plane->frame ? frames_in(motion, *plane->frame) : rest_frames(skeleton);
  context.leaders = leaders_of_columns(skeleton);
  context.rest = rest_coordinates(skeleton);
  context.skeleton_mirror = mirror_of(plane->skeleton_normal);
  context.world_mirror = mirror_of(Vec3::Unit(static_cast<Eigen::Index>(plane->world_axis)));
  if (!plane->is_symmetric) {
    auto reported = fail_or_warn(
        context,
        "left and right do not lie on the two sides of a plane, neither at rest nor in a frame");
    if (!reported) return fail(std::move(reported.error()));
  }
  const auto& pairs = plane->pairs;
  const Rows rows = result.clip.mutate();
  std::vector<JointPlan> following;
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    if (skeleton.joints[j].dofs.empty() &&
        (pairs[j] == kNoParent || skeleton.joints[pairs[j]].dofs.empty())) {
      continue;
    }
    if (pairs[j] == kNoParent) {
      auto reported = fail_or_warn(
          context, fmt::format("joint '{}' has no other half, by name or by where it lies, and "
                               "does not lie in the plane of the mirror",
                               skeleton.joints[j].name));
      if (!reported) return fail(std::move(reported.error()));
    }
    const std::size_t target = pairs[j] == kNoParent ? j : pairs[j];
    const JointPlan plan = plan_joint(context, j, target);
    auto done = mirror_joint(context, plan, rows);
    if (!done) return fail(std::move(done.error()));
    if (plan.follows) following.push_back(plan);
  }
  for (const JointPlan& plan : following) {
    if (is_reached(context, plan, result.clip)) continue;
    auto reported = report_joint(context, plan);
    if (!reported) return fail(std::move(reported.error()));
  }
  return result;
}

}  // namespace kinefile::edit
