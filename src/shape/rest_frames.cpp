// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinefile/joint_rotation.hpp"
#include "kinefile/shape.hpp"
#include "shape/frame_change.hpp"

namespace kinefile::shape {
namespace {

/// Rotates a joint's own frame, with its axes, tips and shapes, and its parent's frame, with its
/// offset.
void turn_frames(Joint& joint, const Mat3& new_from_old, const Mat3& new_from_old_parent) {
  joint.offset = new_from_old_parent * joint.offset;
  for (DegreeOfFreedom& dof : joint.dofs) {
    if (num_coordinates(dof) == 1) dof.axis = (new_from_old * dof.axis).normalized();
  }
  for (Tip& tip : joint.tips) tip.offset = new_from_old * tip.offset;
  for (VisualShape& shape : joint.visuals) {
    shape = in_other_frame(shape, Quat(new_from_old), Vec3::Zero());
  }
  joint.rest_rotation = Quat::Identity();
}

bool moves_along_its_bone(const Joint& joint) {
  return std::any_of(joint.dofs.begin(), joint.dofs.end(), [](const DegreeOfFreedom& dof) {
    return dof.kind == DofKind::TailTranslation;
  });
}

/// Whether a tip is the inner end of a bone: it coincides with a child.
bool is_inner(const Skeleton& skeleton, const Tip& tip, const std::vector<std::size_t>& children) {
  return std::any_of(children.begin(), children.end(), [&](std::size_t child) {
    return skeleton.joints[child].offset == tip.offset;
  });
}

bool has_outer_tip(const Skeleton& skeleton, const Joint& joint,
                   const std::vector<std::size_t>& children) {
  return std::any_of(joint.tips.begin(), joint.tips.end(),
                     [&](const Tip& tip) { return !is_inner(skeleton, tip, children); });
}

/// Gives the translations of a joint's tail to its children.
void hand_down(Motion& motion, std::size_t joint_index, const DegreeOfFreedom& tail,
               const std::vector<std::size_t>& children) {
  for (const std::size_t child : children) {
    Joint& below = motion.skeleton.joints[child];
    DegreeOfFreedom moved = tail;
    moved.kind = DofKind::Translation;
    // Translations act after the rest rotation, so their axes are transformed by it.
    moved.axis = below.rest_rotation.conjugate() * tail.axis;
    below.dofs.insert(below.dofs.begin(), moved);
  }
  auto& dofs = motion.skeleton.joints[joint_index].dofs;
  dofs.erase(std::find_if(dofs.begin(), dofs.end(), [&tail](const DegreeOfFreedom& dof) {
    return dof.kind == DofKind::TailTranslation && dof.coordinate == tail.coordinate;
  }));
}

/// The skeleton of `with_world_aligned_rest`.
Result<Skeleton> world_aligned(Skeleton skeleton) {
  std::vector<Mat3> world_from_rest;
  std::vector<bool> is_turned;
  for (Joint& joint : skeleton.joints) {
    const bool has_turned_parent = joint.parent != kNoParent && is_turned[joint.parent];
    const bool is_rest_turned = !joint.rest_rotation.isApprox(Quat::Identity(), 0);
    const Mat3 parent = has_turned_parent ? world_from_rest[joint.parent] : Mat3::Identity();
    const Mat3 own = parent * joint.rest_rotation.toRotationMatrix();
    world_from_rest.push_back(own);
    is_turned.push_back(has_turned_parent || is_rest_turned);
    if (!is_turned.back()) continue;
    if (is_whole_rotation(rotations_of(joint))) {
      const char* way = moves_freely(joint) ? "moves freely" : "turns in any way";
      return fail(make_error(ErrorKind::DataLoss, "BRG001",
                             fmt::format("joint '{}' {} and is turned in its rest pose, so its "
                                         "values cannot stay as they are",
                                         joint.name, way)));
    }
    turn_frames(joint, own, parent);
  }
  return skeleton;
}

template <class AnyMotion>
Result<AnyMotion> any_with_world_aligned_rest(const AnyMotion& motion) {
  auto skeleton = world_aligned(skeleton_in(motion));
  if (!skeleton) return fail(std::move(skeleton.error()));
  return changed(motion, {std::move(*skeleton)});
}

}  // namespace

Result<Motion> with_world_aligned_rest(const Motion& motion) {
  return any_with_world_aligned_rest(motion);
}
Result<LongMotion> with_world_aligned_rest(const LongMotion& motion) {
  return any_with_world_aligned_rest(motion);
}

Result<Motion> without_tail_translations(const Motion& motion, bool lenient,
                                         Diagnostics& diagnostics) {
  Motion result = motion;
  const auto children = children_of_joints(motion.skeleton);
  for (std::size_t j = 0; j < motion.skeleton.joints.size(); ++j) {
    const Joint joint = result.skeleton.joints[j];  // a copy, because the joint changes below
    if (!moves_along_its_bone(joint)) continue;
    for (const DegreeOfFreedom& dof : joint.dofs) {
      if (dof.kind != DofKind::TailTranslation) continue;
      // Without frames, only the rest pose counts.
      const bool has_frames = motion.clip.num_frames > 0;
      const double first = has_frames ? motion.clip.row(0)[dof.coordinate] : dof.rest;
      const bool is_still =
          value_of(dof, first) == 0 && is_always(motion.clip, dof.coordinate, first);
      const bool moves_tip = !is_still && has_outer_tip(motion.skeleton, joint, children[j]);
      if (moves_tip) {
        Error error = make_error(
            ErrorKind::DataLoss, "BRG002",
            fmt::format("the bone of joint '{}' changes its length, which moves its tip; --lenient "
                        "leaves the tip where it is",
                        joint.name));
        if (!lenient) return fail(std::move(error));
        error.severity = Severity::Warning;
        diagnostics.add(std::move(error));
      }
      hand_down(result, j, dof, is_still ? std::vector<std::size_t>{} : children[j]);
    }
  }
  return result;
}

Motion without_unread_columns(const Motion& motion) {
  const std::vector<std::size_t> readers = num_readers_of_columns(motion.skeleton);
  std::vector<std::size_t> kept;
  std::vector<std::size_t> new_of_old(readers.size());
  for (std::size_t c = 0; c < readers.size(); ++c) {
    new_of_old[c] = kept.size();
    if (readers[c] > 0) kept.push_back(c);
  }
  if (kept.size() == readers.size()) return motion;
  Motion result{motion.skeleton, with_columns(motion.clip, kept)};
  result.skeleton.coordinates.clear();
  for (const std::size_t c : kept) {
    result.skeleton.coordinates.push_back(motion.skeleton.coordinates[c]);
  }
  for (Joint& joint : result.skeleton.joints) {
    for (DegreeOfFreedom& dof : joint.dofs) dof.coordinate = new_of_old[dof.coordinate];
  }
  return result;
}

Motion without_inner_tips(const Motion& motion) {
  Motion result = motion;
  const auto children = children_of_joints(motion.skeleton);
  for (std::size_t j = 0; j < motion.skeleton.joints.size(); ++j) {
    std::vector<Tip>& tips = result.skeleton.joints[j].tips;
    const auto inner = std::remove_if(tips.begin(), tips.end(), [&](const Tip& tip) {
      return is_inner(motion.skeleton, tip, children[j]);
    });
    tips.erase(inner, tips.end());
  }
  return result;
}

}  // namespace kinefile::shape
