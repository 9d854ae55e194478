// SPDX-License-Identifier: MIT
// Mirrored in the plane with S = I - 2 n n^T, the joint j in the world W_j becomes its other half
// k, W'_k = S W_j M_j, where M_j = G_j^-1 S G_k takes j's frame to k's in the pose without angles
// (G). That pose's image is then itself. In its parent's frame k is M_p^-1 L_j M_j, and what its
// degrees of freedom make of it is M_j^-1 D_j M_j: a rotation about a becomes one about M_j^-1 a,
// the other way around. Where no joint is turned at rest, every M is S.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "edit/mirror_pairs.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/joint_rotation.hpp"
#include "kinefile/kinematics.hpp"
#include "kinematics/joint_columns.hpp"
#include "kinematics/rotation_batches.hpp"

namespace kinefile::edit {
namespace {

constexpr double kSamePlace = 1e-9;  // of the skeleton's size
constexpr double kReached = 1e-6;    // what may be left, in radians or of the skeleton's size

/// A column that is copied, with its sign or the other.
struct Copy {
  std::size_t from = 0;
  std::size_t to = 0;
  double sign = 1;
};

/// How the motion of one joint becomes that of its other half.
struct JointPlan {
  std::size_t source = 0;
  std::size_t target = 0;
  Mat3 frame = Mat3::Identity();   ///< M_j: from the target's frame to the source's, mirrored
  Mat3 parent = Mat3::Identity();  ///< M_p^-1: from the source's parent's to the target's parent's
  std::vector<Copy> copies;
  bool is_rotation_found = false;  ///< angles are found anew
  bool is_position_found = false;
};

struct MirrorContext {
  const Motion& motion;
  double size = 0;
  bool lenient = false;
  Diagnostics& diagnostics;
  std::vector<Quat> rest = {};  ///< G: how the joints' frames are turned without angles
};

/// How the frame of every joint is turned in the world where all degrees of freedom are 0.
std::vector<Quat> rest_frames(const Skeleton& skeleton) {
  std::vector<Quat> frames;
  for (const Joint& joint : skeleton.joints) {
    const Quat parent = joint.parent == kNoParent ? Quat(Quat::Identity()) : frames[joint.parent];
    frames.push_back(parent * joint.rest_rotation);
  }
  return frames;
}

/// A vector through a mirror's matrix; exact where that only changes signs.
Vec3 reflect(const Mat3& mirror, const Vec3& v) {
  const Vec3 diagonal = mirror.diagonal();
  if (mirror == Mat3(diagonal.asDiagonal())) return diagonal.cwiseProduct(v);
  return mirror * v;
}

/// +1 or -1 if two unit vectors are the same or opposite.
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

/// Fails, or warns where that is wanted.
Result<void> complain(const MirrorContext& context, std::string message) {
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
  if (from.size() != to.size()) return std::nullopt;
  std::vector<Copy> copies;
  for (std::size_t k = 0; k < from.size(); ++k) {
    const auto sign = sign_between(to[k].axis, reflect(plan.frame.transpose(), from[k].axis));
    if (!sign) return std::nullopt;
    copies.push_back({from[k].coordinate, to[k].coordinate, -*sign});
  }
  return copies;
}

/// The copies that mirror the position, if offsets and axes are each other's mirror images.
std::optional<std::vector<Copy>> copies_of_slides(const JointPlan& plan, const Joint& source,
                                                  const Joint& target, double size) {
  const auto from = translation_columns(source);
  const auto to = translation_columns(target);
  const Vec3 image = reflect(plan.parent, source.offset);
  if (from.size() != to.size() || !((image - target.offset).norm() <= kSamePlace * size)) {
    return std::nullopt;
  }
  std::vector<Copy> copies;
  for (const TranslationColumn& translation : to) {
    for (const TranslationColumn& other : from) {
      const auto sign = sign_between(translation.axis, reflect(plan.parent, other.axis));
      if (sign) copies.push_back({other.column, translation.column, *sign});
    }
  }
  return copies.size() == to.size() ? std::optional(copies) : std::nullopt;
}

/// The copies of what moves and scales the tail: one for one, in order.
void copy_tails(const JointPlan& plan, const Joint& source, const Joint& target, DofKind kind,
                std::vector<Copy>& copies) {
  const auto from = dofs_of_kind(source, kind);
  const auto to = dofs_of_kind(target, kind);
  for (std::size_t k = 0; k < std::min(from.size(), to.size()); ++k) {
    const bool is_opposite = reflect(plan.frame.transpose(), from[k].axis).dot(to[k].axis) < 0;
    const bool is_negated = is_opposite && kind == DofKind::TailTranslation;
    copies.push_back({from[k].coordinate, to[k].coordinate, is_negated ? -1.0 : 1.0});
  }
}

JointPlan plan_joint(const MirrorContext& context, std::size_t source_index,
                     std::size_t target_index, const Mat3& mirror) {
  const Skeleton& skeleton = context.motion.skeleton;
  const Joint& source = skeleton.joints[source_index];
  const Joint& target = skeleton.joints[target_index];
  const auto rest = [&context](std::size_t joint) {
    return joint == kNoParent ? Mat3(Mat3::Identity()) : context.rest[joint].toRotationMatrix();
  };
  JointPlan plan;
  plan.source = source_index;
  plan.target = target_index;
  plan.frame = rest(source_index).transpose() * mirror * rest(target_index);
  plan.parent = rest(target.parent).transpose() * mirror * rest(source.parent);
  const bool is_free = free_column(source) && free_column(target);
  if (is_free) {
    plan.is_rotation_found = true;
  } else if (auto copies = copies_of_rotations(plan, source, target)) {
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

/// Whether two halves have so different ways to move that a motion of one is lost on the other.
bool is_position_lost(const Joint& source, const Joint& target) {
  return translation_columns(source).size() > translation_columns(target).size() ||
         (free_column(source).has_value() != free_column(target).has_value()) ||
         dofs_of_kind(source, DofKind::TailTranslation).size() !=
             dofs_of_kind(target, DofKind::TailTranslation).size() ||
         dofs_of_kind(source, DofKind::TailScale).size() !=
             dofs_of_kind(target, DofKind::TailScale).size();
}

/// Mirrors the quaternion of a free joint by its numbers, which keep their bits.
void mirror_free(const JointPlan& plan, std::size_t from, std::size_t to,
                 std::span<const double> row, std::span<double> result) {
  const Vec3 old_vec(row[from + 4], row[from + 5], row[from + 6]);
  const Vec3 new_vec = -reflect(plan.frame.transpose(), old_vec);
  result[to + 3] = row[from + 3];
  std::copy(new_vec.begin(), new_vec.end(), result.begin() + static_cast<std::ptrdiff_t>(to + 4));
}

/// The quaternions of a joint that moves freely, normalised.
void free_rotations_in_rows(const Clip& clip, const FrameBatch& frames, std::size_t column,
                            simd::Quaternions& out) {
  rotation::resize(out, frames.count);
  for (std::size_t i = 0; i < frames.count; ++i) {
    rotation::put_quaternion(free_rotation(clip.row(frames.first + i), column), i, out);
  }
}

/// Finds the rotation of a joint in all frames. \returns the largest residual angle, in radians
double find_rotations(const MirrorContext& context, const JointPlan& plan, const Rows& rows) {
  const Clip& clip = context.motion.clip;
  const Skeleton& skeleton = context.motion.skeleton;
  const Joint& source = skeleton.joints[plan.source];
  const Joint& target = skeleton.joints[plan.target];
  const auto from = free_column(source);
  const auto to = free_column(target);
  if (from && to) {
    for (std::size_t f = 0; f < clip.num_frames; ++f) {
      mirror_free(plan, *from, *to, clip.row(f), rows[f]);
    }
    return 0;
  }
  const auto rotations = rotations_of(source);
  RotationFitter fitter(rotations_of(target), skeleton.angle_unit, rest_coordinates(skeleton));
  simd::Quaternions found;
  double residual = 0;
  for (const FrameBatch& frames : batches_of(clip.num_frames)) {
    if (from) {
      free_rotations_in_rows(clip, frames, *from, found);
    } else {
      rotations_in_rows(rotations, clip, frames, skeleton.angle_unit, found);
    }
    rotation::turn_axes(-plan.frame.transpose(), found);
    for (std::size_t i = 0; to && i < frames.count; ++i) {
      set_free_rotation(rows[frames.first + i], *to, rotation::quaternion_at(found, i));
    }
    if (!to) residual = std::max(residual, fitter.fit(found, frames, rows));
  }
  return residual;
}

/// Finds the position of a joint in all frames. \returns the largest residual distance
double find_positions(const MirrorContext& context, const JointPlan& plan, const Rows& rows) {
  const Joint& source = context.motion.skeleton.joints[plan.source];
  const Joint& target = context.motion.skeleton.joints[plan.target];
  const auto from = translation_columns(source);
  const auto to = translation_columns(target);
  if (to.empty()) return 0;
  double residual = 0;
  for (std::size_t f = 0; f < context.motion.clip.num_frames; ++f) {
    const Vec3 place = position_in_row(source.offset, from, context.motion.clip.row(f));
    residual =
        std::max(residual, fit_position(target.offset, to, reflect(plan.parent, place), rows[f]));
  }
  return residual;
}

Result<void> mirror_joint(const MirrorContext& context, const JointPlan& plan, const Rows& rows) {
  const Joint& source = context.motion.skeleton.joints[plan.source];
  const Joint& target = context.motion.skeleton.joints[plan.target];
  const Clip& clip = context.motion.clip;
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    for (const Copy& copy : plan.copies) {
      const double value = clip.row(f)[copy.from];
      rows[f][copy.to] = copy.sign < 0 ? -value : value;
    }
  }
  // Both are found, whatever comes of the other.
  const double distance = plan.is_position_found ? find_positions(context, plan, rows) : 0;
  const double angle = plan.is_rotation_found ? find_rotations(context, plan, rows) : 0;
  const bool is_out_of_reach = distance > kReached * context.size || angle > kReached;
  if (!is_out_of_reach && !is_position_lost(source, target)) return {};
  return complain(context, fmt::format("joint '{}' cannot move as '{}' does in the mirror",
                                       target.name, source.name));
}

}  // namespace

Result<Motion> mirror(const Motion& motion, std::size_t axis, bool lenient,
                      Diagnostics& diagnostics) {
  const Skeleton& skeleton = motion.skeleton;
  Motion result = motion;
  if (skeleton.joints.empty()) return result;
  const MirrorContext context{motion, rest_size(skeleton), lenient, diagnostics,
                              rest_frames(skeleton)};
  Vec3 signs = Vec3::Ones();
  signs[static_cast<Eigen::Index>(axis)] = -1;
  const Mat3 mirror = signs.asDiagonal();
  const auto pairs = mirror_pairs(skeleton, axis);
  if (!lie_opposite(skeleton, pairs, axis)) {
    auto complained = complain(
        context, fmt::format("left and right do not lie on the two sides of a mirror whose normal "
                             "is {}; that of this skeleton is {}",
                             "xyz"[axis], "xyz"[guess_mirror_axis(skeleton)]));
    if (!complained) return fail(std::move(complained.error()));
  }
  const Rows rows = result.clip.mutate();
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    if (skeleton.joints[j].dofs.empty() &&
        (pairs[j] == kNoParent || skeleton.joints[pairs[j]].dofs.empty())) {
      continue;
    }
    if (pairs[j] == kNoParent) {
      auto complained = complain(
          context, fmt::format("joint '{}' has no other half, by name or by where it lies, and "
                               "does not lie in the plane of the mirror",
                               skeleton.joints[j].name));
      if (!complained) return fail(std::move(complained.error()));
    }
    const std::size_t target = pairs[j] == kNoParent ? j : pairs[j];
    auto done = mirror_joint(context, plan_joint(context, j, target, mirror), rows);
    if (!done) return fail(std::move(done.error()));
  }
  return result;
}

}  // namespace kinefile::edit
