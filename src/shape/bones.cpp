// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/words.hpp"
#include "kinefile/shape.hpp"
#include "kinematics/column_range.hpp"
#include "shape/frame_change.hpp"
#include "shape/helper_bones.hpp"

namespace kinefile::shape {
namespace {

constexpr char kNoteCode[] = "BRG005";

Error not_bones(const std::string& message) {
  return make_error(ErrorKind::DataLoss, "BRG003", message);
}

/// How the values of one column change.
struct NewColumn {
  std::size_t old_column = 0;
  double minus = 0;
};

struct Builder {
  const Skeleton& old;
  bool has_frames;
  const ColumnRanges& ranges;  ///< of the columns in `deciding_columns`
  Diagnostics& diagnostics;
  Skeleton skeleton = {};
  std::vector<NewColumn> columns = {};
  std::set<std::string> names = {"root"};               ///< in lower case
  std::set<std::string> names_of_joints = {};           ///< in lower case; helpers must not have
                                                        ///< these
  std::map<std::string, std::size_t> last_number = {};  ///< the number that made a name unique
  std::vector<std::size_t> new_of_old = {};             ///< the new index of an old joint
  std::vector<std::string> added = {};                  ///< helper bones with a length
  std::vector<std::string> renamed = {};
  std::vector<std::string> with_positions = {};     ///< joints other than roots with translations
  std::vector<std::string> without_positions = {};  ///< and those whose translations never change
  std::vector<std::string> with_rest_values = {};   ///< joints with rest values other than 0

  std::vector<Joint>& joints() { return skeleton.joints; }
};

std::string unique_name(Builder& builder, const std::string& wanted) {
  std::string name = wanted;
  std::size_t& number = builder.last_number[lowered(wanted)];  // so that many equal names are
                                                               // numbered fast
  while (!builder.names.insert(lowered(name)).second) {
    number = std::max<std::size_t>(number, 1) + 1;
    name = fmt::format("{}_{}", wanted, number);
  }
  return name;
}

/// A name for a helper bone that no joint has.
std::string helper_name(Builder& builder, const std::string& stem,
                        std::string_view suffix = kHelperSuffix) {
  std::string name = as_bone_name(fmt::format("{}{}", stem, suffix));
  std::size_t& number = builder.last_number[lowered(name)];
  while (builder.names_of_joints.contains(lowered(name)) ||
         !builder.names.insert(lowered(name)).second) {
    number = std::max<std::size_t>(number, 1) + 1;
    name = as_bone_name(fmt::format("{}_{}{}", stem, number, suffix));
  }
  return name;
}

std::size_t add_joint(Builder& builder, std::string name, std::size_t parent, const Vec3& end) {
  Joint joint;
  joint.name = std::move(name);
  joint.parent = parent;
  const bool is_on_root = builder.joints()[parent].parent == kNoParent;
  if (!is_on_root) joint.offset = builder.joints()[parent].tips.front().offset;
  joint.tips.push_back({"", end});
  builder.joints().push_back(std::move(joint));
  return builder.joints().size() - 1;
}

enum class Dofs { All, OfTail, AllButTail };

/// Adds degrees of freedom of an old joint to a new one, with rest values of 0.
void add_dofs(Builder& builder, std::size_t old_index, std::size_t new_index, bool is_root,
              Dofs which = Dofs::All) {
  const Joint& old = builder.old.joints[old_index];
  bool has_moved = false;
  bool has_rested = false;
  bool loses_rest = false;
  for (DegreeOfFreedom dof : old.dofs) {
    const bool is_of_tail = dof.kind == DofKind::TailTranslation;
    if (which == (is_of_tail ? Dofs::AllButTail : Dofs::OfTail)) continue;
    NewColumn column{dof.coordinate, 0};
    const std::string channel = builder.old.coordinates[dof.coordinate].channel;
    if (dof.kind == DofKind::Translation && !is_root) {
      const bool rests = is_always(builder.ranges.at(dof.coordinate), dof.rest);
      has_moved |= !rests;
      has_rested |= rests;
      if (rests) continue;
      column.minus = dof.rest;
    }
    if (dof.kind == DofKind::TailScale) continue;  // it has no effect, as checked before
    loses_rest |= dof.rest != 0 && dof.kind != DofKind::Translation;
    dof.lower -= column.minus;
    dof.upper -= column.minus;
    dof.rest = 0;
    dof.coordinate = builder.columns.size();
    builder.columns.push_back(column);
    builder.skeleton.coordinates.push_back({new_index, channel});
    builder.joints()[new_index].dofs.push_back(dof);
  }
  if (loses_rest) builder.with_rest_values.push_back(old.name);
  if (has_moved) builder.with_positions.push_back(old.name);
  if (has_rested && !has_moved) builder.without_positions.push_back(old.name);
}

/// The position of a joint's children, if all of them are at one place.
std::optional<Vec3> common_place(const Skeleton& skeleton,
                                 const std::vector<std::size_t>& children) {
  if (children.empty()) return std::nullopt;
  const Vec3 first = rest_offset(skeleton.joints[children.front()]);
  const bool is_common = std::all_of(children.begin(), children.end(), [&](std::size_t child) {
    return rest_offset(skeleton.joints[child]) == first;
  });
  return is_common ? std::optional(first) : std::nullopt;
}

/// The end of a bone: the place of its children, otherwise its first tip, otherwise its start.
Vec3 end_of_bone(const Joint& joint, const std::optional<Vec3>& place, bool has_children) {
  if (place) return *place;
  return has_children || joint.tips.empty() ? Vec3(Vec3::Zero()) : joint.tips.front().offset;
}

void add_tips(Builder& builder, const Joint& old, std::size_t holder, const Vec3& end) {
  bool is_end_taken = false;
  for (const Tip& tip : old.tips) {
    if (tip.offset == end && !std::exchange(is_end_taken, true)) continue;
    const std::string wanted = tip.name.empty() ? old.name + "_end" : tip.name;
    const std::string name = helper_name(builder, wanted);
    add_joint(builder, name, holder, tip.offset - end);
    builder.added.push_back(name);
  }
}

/// The new parent of a child: the joint made from its parent, or a bone that leads to the child's
/// place.
std::size_t holder_of_child(Builder& builder, const Joint& child) {
  const std::size_t holder = builder.new_of_old[child.parent];
  const Joint& bone = builder.joints()[holder];
  const Vec3 end = bone.parent == kNoParent ? Vec3(Vec3::Zero()) : bone.tips.front().offset;
  if (rest_offset(child) == end) return holder;
  const std::string name = helper_name(builder, child.name);
  builder.added.push_back(name);
  return add_joint(builder, name, holder, rest_offset(child) - end);
}

/// Adds the bone that keeps the root's old name: a helper, unless it translates its tail.
std::size_t add_named_bone(Builder& builder, std::size_t old_index, const Vec3& end) {
  const Joint& old = builder.old.joints[old_index];
  const bool has_tail = std::any_of(old.dofs.begin(), old.dofs.end(), [](const auto& dof) {
    return dof.kind == DofKind::TailTranslation;
  });
  const std::string wanted = has_tail ? old.name : fmt::format("{}{}", old.name, kRootHelperSuffix);
  const std::string name = has_tail ? unique_name(builder, as_bone_name(old.name))
                                    : helper_name(builder, old.name, kRootHelperSuffix);
  if (name != wanted) builder.renamed.push_back(old.name + "' to '" + name);
  const std::size_t index = add_joint(builder, name, 0, end);
  builder.joints()[index].kept = old.kept;
  builder.joints()[index].visuals = old.visuals;
  add_dofs(builder, old_index, index, true, Dofs::OfTail);
  return index;
}

/// Adds the root, and a bone of its old name if it had another one.
void add_root(Builder& builder, std::size_t old_index, const std::vector<std::size_t>& children) {
  const Joint& old = builder.old.joints[old_index];
  Joint root;
  root.name = "root";
  // Coordinates rest at 0 from now on: without translations, the offset gives the rest pose.
  const bool has_frames = builder.has_frames;
  root.offset = has_frames ? old.offset : rest_offset(old);
  root.rest_rotation = old.rest_rotation;
  const bool keeps_name = lowered(old.name) == "root";
  if (keeps_name) root.kept = old.kept;
  if (keeps_name) root.visuals = old.visuals;
  if (has_frames && rest_offset(old) != old.offset) {
    builder.diagnostics.add(
        Severity::Note, kNoteCode,
        fmt::format("the root rests at the origin, not where '{}' did", old.name));
  }
  builder.joints().push_back(std::move(root));
  add_dofs(builder, old_index, 0, true, keeps_name ? Dofs::All : Dofs::AllButTail);
  builder.new_of_old.push_back(0);
  Vec3 end = Vec3::Zero();
  if (keeps_name) {
    if (old.name != "root") builder.renamed.push_back(old.name + "' to 'root");
  } else {
    end = end_of_bone(old, common_place(builder.old, children), !children.empty());
    builder.new_of_old.back() = add_named_bone(builder, old_index, end);
  }
  add_tips(builder, old, builder.new_of_old.back(), end);
}

void add_bone(Builder& builder, std::size_t old_index, const std::vector<std::size_t>& children) {
  const Joint& old = builder.old.joints[old_index];
  const std::size_t holder = holder_of_child(builder, old);
  const Vec3 end = end_of_bone(old, common_place(builder.old, children), !children.empty());
  const std::string name = unique_name(builder, as_bone_name(old.name));
  if (name != old.name) builder.renamed.push_back(old.name + "' to '" + name);
  const std::size_t index = add_joint(builder, name, holder, end);
  builder.joints()[index].kept = old.kept;
  builder.joints()[index].visuals = old.visuals;
  builder.new_of_old.push_back(index);
  add_dofs(builder, old_index, index, false);
  add_tips(builder, old, index, end);
}

/// The reason why a skeleton cannot have bones.
std::optional<Error> obstacle_of(const Skeleton& skeleton) {
  std::size_t num_roots = 0;
  for (const Joint& joint : skeleton.joints) {
    num_roots += joint.parent == kNoParent ? 1 : 0;
    for (const DegreeOfFreedom& dof : joint.dofs) {
      if (dof.kind == DofKind::Free) {
        return not_bones(
            fmt::format("bones turn and move along axes; '{}' moves freely", joint.name));
      }
    }
  }
  if (num_roots != 1) return not_bones(fmt::format("bones have one root, found {}", num_roots));
  return std::nullopt;
}

/// The first joint that is scaled in the motion, or at rest where there are no frames.
std::optional<std::string> scaled_joint(const Builder& builder) {
  for (const Joint& joint : builder.old.joints) {
    for (const DegreeOfFreedom& dof : joint.dofs) {
      if (dof.kind != DofKind::TailScale) continue;
      const bool is_scaled =
          builder.has_frames ? !is_always(builder.ranges.at(dof.coordinate), 1) : dof.rest != 1;
      if (is_scaled) return joint.name;
    }
  }
  return std::nullopt;
}

/// The columns whose numbers decide which bones there are: positions below the root that never
/// change are left out, and nothing may be scaled.
std::vector<std::size_t> deciding_columns(const Skeleton& skeleton) {
  std::vector<std::size_t> columns;
  for (const Joint& joint : skeleton.joints) {
    for (const DegreeOfFreedom& dof : joint.dofs) {
      const bool is_position = dof.kind == DofKind::Translation && joint.parent != kNoParent;
      if (is_position || dof.kind == DofKind::TailScale) columns.push_back(dof.coordinate);
    }
  }
  return columns;
}

/// Whether a joint below the root has a rest rotation. Bones have none; only their axes are
/// rotated.
bool is_turned_below_root(const Skeleton& skeleton) {
  return std::any_of(skeleton.joints.begin(), skeleton.joints.end(), [](const Joint& joint) {
    return joint.parent != kNoParent && !joint.rest_rotation.isApprox(Quat::Identity(), 0);
  });
}

/// Whether the motion has bones already.
bool is_of_bones(const Skeleton& skeleton) {
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    for (const DegreeOfFreedom& dof : joint.dofs) {
      if (dof.rest != 0 || dof.kind == DofKind::TailScale || num_coordinates(dof) > 1) return false;
    }
    if (j == 0) {
      if (joint.parent != kNoParent || joint.name != "root" || !joint.tips.empty()) return false;
      continue;
    }
    if (joint.parent == kNoParent || joint.tips.size() != 1) return false;
    const Joint& parent = skeleton.joints[joint.parent];
    const Vec3 start = joint.parent == 0 ? Vec3(Vec3::Zero()) : parent.tips.front().offset;
    if (joint.offset != start || !is_bone_name(joint.name)) return false;
  }
  return !skeleton.joints.empty();
}

void fill_values(const Clip& clip, const std::vector<NewColumn>& columns, const Rows& rows) {
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const double value = clip.row(f)[columns[c].old_column];
      rows[f][c] = columns[c].minus == 0 ? value : value - columns[c].minus;
    }
  }
}

/// Bones cannot keep columns that no degree of freedom reads.
void report_unread(Builder& builder) {
  const std::vector<std::size_t> readers = num_readers_of_columns(builder.old);
  const std::vector<std::string> names = column_names(builder.old);
  for (std::size_t c = 0; c < readers.size(); ++c) {
    if (readers[c] > 0) continue;
    builder.diagnostics.add(Severity::Warning, kNoteCode,
                            fmt::format("column '{}' moves nothing and is left out", names[c]));
  }
}

void report_changes(Builder& builder) {
  const auto note = [&builder](Severity severity, const std::vector<std::string>& names,
                               std::string_view text) {
    if (names.empty()) return;
    builder.diagnostics.add(severity, kNoteCode, fmt::format("{}: {}", text, listed(names)));
  };
  note(Severity::Note, builder.added,
       "helper bones lead to joints and tips that do not sit where a bone ends");
  note(Severity::Warning, builder.renamed, "names that no bone can have were changed");
  note(Severity::Note, builder.without_positions,
       "positions of joints that never leave their offset are left out");
  note(Severity::Note, builder.with_rest_values,
       "bones rest where all values are 0, not as these joints did");
  note(Severity::Warning, builder.with_positions,
       "positions of joints other than the root are written as tx ty tz, which few programs read");
}

/// Whether some values have a gain or a shift, or some rotations are not angles.
bool has_other_values(const Skeleton& skeleton) {
  const bool has_any =
      std::any_of(skeleton.joints.begin(), skeleton.joints.end(), [](const Joint& joint) {
        return std::any_of(joint.dofs.begin(), joint.dofs.end(), [](const auto& dof) {
          return !is_plain(dof) || num_coordinates(dof) > 1;
        });
      });
  return has_any || !following_columns(skeleton).empty();
}

/// Tells that a scale is lost.
/// \errors BRG003 (DataLoss) unless `lenient`
Result<void> leave_out_scale(const Builder& builder, bool lenient) {
  const auto scaled = scaled_joint(builder);
  if (!scaled) return {};
  Error error = not_bones(fmt::format("bones cannot be scaled as '{}' is", *scaled));
  if (!lenient) return fail(std::move(error));
  error.severity = Severity::Warning;
  error.message += "; its scale is left out";
  builder.diagnostics.add(std::move(error));
  return {};
}

/// Makes the bones of a skeleton without gains, shifts and rest rotations.
/// \param ranges  of the columns in `deciding_columns`
Result<FrameChange> bones_of(const Skeleton& old, bool has_frames, const ColumnRanges& ranges,
                             bool lenient, Diagnostics& diagnostics) {
  Builder builder{old, has_frames, ranges, diagnostics};
  if (auto left = leave_out_scale(builder, lenient); !left) return fail(std::move(left.error()));
  builder.skeleton.name = old.name;
  builder.skeleton.angle_unit = old.angle_unit;
  builder.skeleton.metres_per_unit = old.metres_per_unit;
  builder.skeleton.up = old.up;
  for (const Joint& joint : old.joints) {
    builder.names_of_joints.insert(lowered(as_bone_name(joint.name)));
  }
  const auto children = children_of_joints(old);
  for (std::size_t j = 0; j < old.joints.size(); ++j) {
    if (old.joints[j].parent == kNoParent) {
      add_root(builder, j, children[j]);
    } else {
      add_bone(builder, j, children[j]);
    }
  }
  report_unread(builder);
  report_changes(builder);
  return FrameChange{std::move(builder.skeleton),
                     [columns = std::move(builder.columns)](const Clip& next, const Rows& rows) {
                       fill_values(next, columns, rows);
                     }};
}

template <class AnyMotion>
Result<AnyMotion> any_with_bones(const AnyMotion& motion, bool lenient, Diagnostics& diagnostics) {
  const Skeleton& skeleton = skeleton_in(motion);
  if (auto obstacle = obstacle_of(skeleton)) return fail(std::move(*obstacle));
  if (has_other_values(skeleton)) {
    constexpr RotationOrder kUsualOrder = {2, 1, 0};
    return any_with_bones(with_angles(with_plain_values(motion), kUsualOrder), lenient,
                          diagnostics);
  }
  if (is_turned_below_root(skeleton)) {
    const auto aligned = with_world_aligned_rest(motion);
    if (!aligned) return fail(aligned.error());
    return any_with_bones(*aligned, lenient, diagnostics);
  }
  if (is_of_bones(skeleton)) return motion;
  const auto ranges =
      ranges_of_columns([&motion](UseBlock use) { return for_each_block_of(motion, use); },
                        skeleton.coordinates.size(), deciding_columns(skeleton));
  if (!ranges) return fail(ranges.error());
  auto bones = bones_of(skeleton, num_frames_of(motion) > 0, *ranges, lenient, diagnostics);
  if (!bones) return fail(std::move(bones.error()));
  return changed(motion, std::move(*bones));
}

}  // namespace

Result<Motion> with_bones(const Motion& motion, bool lenient, Diagnostics& diagnostics) {
  return any_with_bones(motion, lenient, diagnostics);
}
Result<LongMotion> with_bones(const LongMotion& motion, bool lenient, Diagnostics& diagnostics) {
  return any_with_bones(motion, lenient, diagnostics);
}

}  // namespace kinefile::shape
