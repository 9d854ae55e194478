// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "kinefile/edit.hpp"
#include "kinefile/kinematics.hpp"
#include "kinematics/joint_columns.hpp"
#include "model/joint_names.hpp"

namespace kinefile::edit {
namespace {

Error no_such_joint(const std::string& name) {
  return make_error(ErrorKind::Usage, "EDT006", fmt::format("there is no joint '{}'", name));
}

/// The joints with some names and all their ancestors.
Result<std::vector<bool>> select_with_ancestors(const Skeleton& skeleton,
                                                std::span<const std::string> names) {
  std::vector<bool> is_kept(skeleton.joints.size(), false);
  const JointNames known(skeleton);
  for (const std::string& name : names) {
    const std::vector<std::size_t> found = known.matching(name);
    if (found.empty()) return fail(no_such_joint(name));
    for (const std::size_t j : found) is_kept[j] = true;
  }
  // Parents come first, so that going backwards meets every child before its parent.
  for (std::size_t j = skeleton.joints.size(); j-- > 0;) {
    const std::size_t parent = skeleton.joints[j].parent;
    if (is_kept[j] && parent != kNoParent) is_kept[parent] = true;
  }
  return is_kept;
}

/// The place of a joint in its parent's frame in all frames.
struct FixedPlace {
  Vec3 place = Vec3::Zero();
  double noise = 0;  ///< how far the joint is from it at the most, along one axis
};

/// Nothing if the joint moves by more than noise.
std::optional<FixedPlace> fixed_place(const Joint& joint, const Clip& clip, double size) {
  const double noise = noise_of_place(joint, size);
  FixedPlace fixed;
  std::vector<double> row(clip.num_coordinates, 0.0);
  const std::vector<Translation> translations = translations_of(joint);
  for (const auto& [axis, dof] : translations) {
    const double gain = std::abs(dof.gain);
    const auto settled = settled_number(range_of_column(clip, dof.coordinate), dof.rest,
                                        gain > 0 ? noise / gain : noise);
    if (!settled) return std::nullopt;
    row[dof.coordinate] = settled->number;
    fixed.noise = std::max(fixed.noise, gain * settled->loss);
  }
  fixed.place = position_in_row(joint.offset, translations, row);
  return fixed;
}

/// Adds tips at the positions of a joint's removed children.
void add_tips(const Motion& motion, const std::vector<std::size_t>& children, Joint& joint,
              Diagnostics& diagnostics) {
  const double size = rest_size(motion.skeleton);
  for (const std::size_t c : children) {
    const Joint& child = motion.skeleton.joints[c];
    const auto fixed = fixed_place(child, motion.clip, size);
    if (!fixed) {
      diagnostics.add(Severity::Warning, "EDT010",
                      fmt::format("joint '{}' moves on '{}', which gets a tip where it rests",
                                  child.name, joint.name));
    } else if (fixed->noise > 0) {
      diagnostics.add(Severity::Note, "EDT013",
                      fmt::format("joint '{}' stays on '{}' but for noise of {:.2g}, which is lost",
                                  child.name, joint.name, fixed->noise));
    }
    joint.tips.push_back({"", fixed ? fixed->place : rest_offset(child)});
  }
}

/// Where a removed joint is that cannot move on the joint that remains above it.
struct FixedFrame {
  std::size_t holder = 0;  ///< the joint that remains, or the joint itself
  Quat rotation = Quat::Identity();
  Vec3 place = Vec3::Zero();
};

bool moves_its_children(const Joint& joint) {
  return std::any_of(joint.dofs.begin(), joint.dofs.end(), [](const DegreeOfFreedom& dof) {
    return dof.kind == DofKind::TailTranslation || dof.kind == DofKind::TailScale;
  });
}

/// The frames of joints that remain or are fixed to one; shape (joints).
std::vector<std::optional<FixedFrame>> fixed_frames(const Skeleton& skeleton,
                                                    const std::vector<bool>& is_kept) {
  std::vector<std::optional<FixedFrame>> frames;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    auto& frame = frames.emplace_back();
    if (is_kept[j]) {
      frame = FixedFrame{j};
    } else if (joint.parent != kNoParent && frames[joint.parent] && joint.dofs.empty() &&
               !moves_its_children(skeleton.joints[joint.parent])) {
      const FixedFrame& above = *frames[joint.parent];
      frame = FixedFrame{above.holder, (above.rotation * joint.rest_rotation).normalized(),
                         above.place + above.rotation * joint.offset};
    }
  }
  return frames;
}

/// Gives the shapes of removed joints that cannot move to the joints that remain above them.
void hand_up_fixed_shapes(const Skeleton& old, const std::vector<bool>& is_kept,
                          const std::vector<std::size_t>& new_joints, Skeleton& skeleton) {
  const auto frames = fixed_frames(old, is_kept);
  for (std::size_t j = 0; j < old.joints.size(); ++j) {
    if (is_kept[j] || !frames[j]) continue;
    std::vector<VisualShape>& shapes = skeleton.joints[new_joints[frames[j]->holder]].visuals;
    for (const VisualShape& shape : old.joints[j].visuals) {
      shapes.push_back(in_other_frame(shape, frames[j]->rotation, frames[j]->place));
    }
  }
}

constexpr std::size_t kDropped = std::numeric_limits<std::size_t>::max();

/// The new index of each element that is kept, kDropped for others.
std::vector<std::size_t> new_indices(const std::vector<bool>& is_kept) {
  std::vector<std::size_t> indices(is_kept.size(), kDropped);
  std::size_t next = 0;
  for (std::size_t i = 0; i < is_kept.size(); ++i) {
    if (is_kept[i]) indices[i] = next++;
  }
  return indices;
}

/// The joint that each column belongs to now: its own if that is kept, otherwise the first kept
/// joint that reads it (a mimic joint); kDropped if there is none.
std::vector<std::size_t> owners_of_columns(const Skeleton& skeleton,
                                           const std::vector<bool>& is_kept) {
  std::vector<std::size_t> owners(skeleton.coordinates.size(), kDropped);
  for (std::size_t c = 0; c < owners.size(); ++c) {
    if (is_kept[skeleton.coordinates[c].joint]) owners[c] = skeleton.coordinates[c].joint;
  }
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (!is_kept[j]) continue;
    for (const DegreeOfFreedom& dof : skeleton.joints[j].dofs) {
      for (std::size_t k = 0; k < num_coordinates(dof); ++k) {
        std::size_t& owner = owners[dof.coordinate + k];
        if (owner == kDropped) owner = j;
      }
    }
  }
  return owners;
}

bool has_joint(const Skeleton& skeleton, const std::string& name) {
  return std::any_of(skeleton.joints.begin(), skeleton.joints.end(),
                     [&name](const Joint& joint) { return joint.name == name; });
}

}  // namespace

Result<Motion> joints(const Motion& motion, std::span<const std::string> names,
                      Diagnostics& diagnostics) {
  const Skeleton& skeleton = motion.skeleton;
  const auto is_kept = select_with_ancestors(skeleton, names);
  if (!is_kept) return fail(is_kept.error());
  const auto new_joints = new_indices(*is_kept);
  const auto owners = owners_of_columns(skeleton, *is_kept);
  std::vector<bool> is_column_kept;
  for (const std::size_t owner : owners) is_column_kept.push_back(owner != kDropped);
  const auto new_columns = new_indices(is_column_kept);
  const auto children = children_of_joints(skeleton);

  Motion result{skeleton, {}};
  result.skeleton.joints.clear();
  result.skeleton.coordinates.clear();
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (!(*is_kept)[j]) continue;
    Joint joint = skeleton.joints[j];
    if (joint.parent != kNoParent) joint.parent = new_joints[joint.parent];
    for (DegreeOfFreedom& dof : joint.dofs) dof.coordinate = new_columns[dof.coordinate];
    const bool is_bare = std::none_of(children[j].begin(), children[j].end(),
                                      [&is_kept](std::size_t child) { return (*is_kept)[child]; });
    if (is_bare && joint.tips.empty()) add_tips(motion, children[j], joint, diagnostics);
    result.skeleton.joints.push_back(std::move(joint));
  }
  hand_up_fixed_shapes(skeleton, *is_kept, new_joints, result.skeleton);
  std::vector<std::size_t> kept_columns;
  for (std::size_t c = 0; c < owners.size(); ++c) {
    if (owners[c] == kDropped) continue;
    kept_columns.push_back(c);
    result.skeleton.coordinates.push_back({new_joints[owners[c]], skeleton.coordinates[c].channel});
  }
  result.clip = with_columns(motion.clip, kept_columns);
  return result;
}

Result<void> rename(Document& document, const std::string& old_name, const std::string& new_name) {
  Motion* motion = std::get_if<Motion>(&document.content);
  Skeleton* const found =
      motion != nullptr ? &motion->skeleton : std::get_if<Skeleton>(&document.content);
  if (found == nullptr) {
    return fail(wrong_kind(document, "a motion or a skeleton, which have joints to rename"));
  }
  Skeleton& skeleton = *found;
  if (!has_joint(skeleton, old_name)) return fail(no_such_joint(old_name));
  if (new_name == old_name) return {};
  if (new_name.empty() || has_joint(skeleton, new_name)) {
    const std::string why = new_name.empty()
                                ? "a joint needs a name"
                                : fmt::format("there is a joint '{}' already", new_name);
    return fail(make_error(ErrorKind::Usage, "EDT006", why));
  }
  for (Joint& joint : skeleton.joints) {
    if (joint.name == old_name) joint.name = new_name;
  }
  return {};
}

}  // namespace kinefile::edit
