// SPDX-License-Identifier: MIT
#include "edit/mirror_plan.hpp"

#include <algorithm>
#include <utility>

#include "kinefile/joint_rotation.hpp"
#include "kinefile/kinematics.hpp"
#include "kinematics/joint_columns.hpp"

namespace kinefile::edit {
namespace {

constexpr double kSamePlace = 1e-9;  // of the skeleton's size

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
  std::erase_if(plan.copies, [&](const Copy& copy) {
    return context.leaders[copy.to.coordinate] != target_index;
  });
  return plan;
}

}  // namespace

Vec3 reflect(const Mat3& mirror, const Vec3& v) {
  const Vec3 diagonal = mirror.diagonal();
  if (mirror == Mat3(diagonal.asDiagonal())) return diagonal.cwiseProduct(v);
  return mirror * v;
}

MirrorContext mirror_context(const Motion& motion, const MirrorPlane& plane, bool lenient,
                             Diagnostics& diagnostics) {
  const Skeleton& skeleton = motion.skeleton;
  MirrorContext context{motion, rest_size(skeleton), lenient, diagnostics};
  context.is_at_rest = !plane.frame.has_value();
  context.frames = plane.frame ? frames_in(motion, *plane.frame) : rest_frames(skeleton);
  context.leaders = leaders_of_columns(skeleton);
  context.rest = rest_coordinates(skeleton);
  context.skeleton_mirror = mirror_of(plane.skeleton_normal);
  context.world_mirror = mirror_of(Vec3::Unit(static_cast<Eigen::Index>(plane.world_axis)));
  return context;
}

std::vector<JointPlan> plan_joints(const MirrorContext& context,
                                   const std::vector<std::size_t>& pairs) {
  const std::vector<Joint>& joints = context.motion.skeleton.joints;
  std::vector<bool> is_target(joints.size(), false);
  std::vector<JointPlan> plans;
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    const bool has_partner = pairs[j] != kNoParent;
    const std::size_t target = has_partner ? pairs[j] : j;
    if (joints[j].dofs.empty() && joints[target].dofs.empty()) continue;
    plans.push_back(plan_joint(context, j, target));
    plans.back().has_partner = has_partner;
    plans.back().is_alone = !plans.back().follows && !is_target[target];
    is_target[target] = true;
  }
  std::stable_partition(plans.begin(), plans.end(),
                        [](const JointPlan& plan) { return plan.is_alone; });
  return plans;
}

bool is_position_lost(const Joint& source, const Joint& target) {
  return translations_of(source).size() > translations_of(target).size() ||
         moves_freely(source) != moves_freely(target) ||
         dofs_of_kind(source, DofKind::TailTranslation).size() !=
             dofs_of_kind(target, DofKind::TailTranslation).size() ||
         dofs_of_kind(source, DofKind::TailScale).size() !=
             dofs_of_kind(target, DofKind::TailScale).size();
}

}  // namespace kinefile::edit
