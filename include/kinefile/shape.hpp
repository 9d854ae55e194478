// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "kinefile/frame_source.hpp"
#include "kinefile/motion.hpp"
#include "kinefile/result.hpp"

#pragma GCC visibility push(default)

namespace kinefile::shape {

// Functions that also take a `LongMotion` change its frames when these are asked for, and read all
// of them before where that decides how: they add the errors of `FrameSource::rows`. Frames are
// best asked for in their order: the angles of one depend on those before.

/// The axes of three rotations, outermost first: 0 x, 1 y, 2 z. "ZXY" is {2, 0, 1}.
using RotationOrder = std::array<std::size_t, 3>;

/// The same motion in which the value of every degree of freedom is the number in its column: gains
/// are 1 and shifts 0. A joint that follows another by gain and shift, or that has a following
/// column (see `following_columns`), gets its values in its own column.
Motion with_plain_values(const Motion& motion);
LongMotion with_plain_values(const LongMotion& motion);

/// The same motion with three rotations instead of each ball and each rotation vector; angles are
/// nearest to the previous frame. Joints that move freely stay.
Motion with_angles(const Motion& motion, const RotationOrder& order);
LongMotion with_angles(const LongMotion& motion, const RotationOrder& order);

/// The same motion of a skeleton whose joints have the world's axes in the rest pose: offsets,
/// axes, tips and shapes are rotated, rest rotations become identity. Values stay the same bit for
/// bit. \errors BRG001 (DataLoss) if a joint that moves freely, or has a ball or a rotation vector,
/// or
///         one of its ancestors, has a rest rotation
Result<Motion> with_world_aligned_rest(const Motion& motion);
Result<LongMotion> with_world_aligned_rest(const LongMotion& motion);

/// The same motion without translations along bones (ASF `l`): the children of such a joint get the
/// translation instead, by the same columns.
/// \errors BRG002 (DataLoss) if a tip is translated and no child coincides with it, and not
///         `lenient`
Result<Motion> without_tail_translations(const Motion& motion, bool lenient,
                                         Diagnostics& diagnostics);

/// The same motion without columns that no degree of freedom reads.
Motion without_unread_columns(const Motion& motion);

/// The same motion without tips that coincide with a child: the inner ends of bones.
Motion without_inner_tips(const Motion& motion);

/// The same motion of a skeleton of bones, as ASF has it: one root called "root", and joints with
/// one tip each, the bone's end, at which all of its children are. If children are at several
/// places, or a joint has several tips, helper bones lead there. They have no degrees of freedom,
/// and names that end in `_kf_helper` after the name of the child, of the tip, or JOINT_end. A root
/// of another name gets a helper of that name as its first bone, or a bone of that name if it
/// translates its tail. `without_helper_bones` is the inverse.
/// Translations of joints other than the root are relative to the rest pose, so that all
/// coordinates rest at 0; translations that are always 0 are removed. Names that ASF cannot hold
/// are changed. Joints below the root with rest rotations get the world's axes (see
/// `with_world_aligned_rest`). Balls and rotation vectors become angles about z, y and x; gains and
/// shifts are applied to the values (see `with_angles`, `with_plain_values`). Notes report what was
/// added, changed or removed. Positions of joints in the world stay the same.
/// \errors BRG003 (DataLoss) if there are several roots, or joints are scaled, or move freely
Result<Motion> with_bones(const Motion& motion, bool lenient, Diagnostics& diagnostics);
Result<LongMotion> with_bones(const LongMotion& motion, bool lenient, Diagnostics& diagnostics);

/// The same motion without the helper bones that `with_bones` adds: joints below a root whose names
/// end in `_kf_helper`, without degrees of freedom, columns and rest rotations. Children of a
/// helper bone are attached to its parent, with the sum of the offsets; the tips that it leads to,
/// and its shapes, become those of its parent; a root called "root" gets the name that its first
/// bone keeps, if no joint has it. Everything else, including all values, stays the same. A note
/// reports what was removed.
Motion without_helper_bones(Motion motion, Diagnostics& diagnostics);

/// Transfers a motion to another skeleton, between joints of the same name (case is ignored unless
/// two joints differ by case alone). The first joints of both are matched regardless of their
/// names. Rotations, translations and tails are transferred relative to the rest poses, which are
/// assumed to show the same pose; roots get the positions of the original roots. All of this is
/// limited by the degrees of freedom of the other skeleton. If both joints have the same motion
/// from the same values, these are copied bit for bit. Warnings report joints that are missing on
/// either side, and motion that cannot be transferred.
/// \errors BRG004 (Usage) if no joint names match, or a joint moves freely
Result<Motion> onto_skeleton(const Motion& motion, const Skeleton& skeleton,
                             Diagnostics& diagnostics);

/// Reads an order of rotations, in any case: three of x, y and z of which no neighbours are equal.
std::optional<RotationOrder> parse_rotation_order(std::string_view text);

/// Which joints have position channels.
enum class PositionChannels {
  AsIs,        ///< the joints that have them already
  Root,        ///< only roots; every joint turns about three axes
  All,         ///< every joint; every joint turns about three axes
  RootAndOwn,  ///< roots and the joints that have some, which turn about three axes as the joints
               ///< that turn at all do: what the importers of BVH accept
};

struct ChannelOptions {
  /// Absent: each joint's own, or `usual_order` if it has none.
  std::optional<RotationOrder> order = std::nullopt;
  RotationOrder usual_order = {2, 0, 1};
  std::optional<PositionChannels> positions = std::nullopt;  ///< absent: `usual_positions`
  PositionChannels usual_positions = PositionChannels::AsIs;
  bool adds_positions = false;  ///< new position channels are added to offsets and do not replace
                                ///< them; if the motion's own channels show what they do, new ones
                                ///< do the same
  bool replaces_offsets = false;  ///< positions replace offsets, regardless of the motion's own
                                  ///< channels
  bool distinct_axes = false;     ///< joints with two rotations about one axis get `usual_order`,
                                  ///< those with two translations along one get x, y and z
  bool lenient = false;           ///< drop positions that change, with a warning
};

/// Whether a joint has two rotations about one axis, as in the order ZXZ, or two translations along
/// one.
bool repeats_an_axis(const Joint& joint);

/// The same motion with other channels: positions and rotations in the world stay the same.
/// Joints whose rotations have the order already keep every bit. Angles of other joints are
/// recomputed, each nearest to the previous frame, so that curves stay continuous. With `AsIs`, a
/// joint with one rotation, or with some in the order's sequence, keeps them. Otherwise a joint
/// with one or two rotations about x, y or z keeps their values, and gets the rotations that it
/// lacks as zeros. Joints with rotations about or translations along axes other than x, y and z, or
/// with shared columns, get new rotations about and positions along x, y and z. Balls and rotation
/// vectors become angles; values with a gain or a shift get their own columns.
/// If a joint loses its position channels and they are constant, they become part of its offset; so
/// do those that waver by a thousandth of its bone at the most (see `noise_of_place`), with a note
/// of what is lost (EDT013).
/// \errors EDT001 (DataLoss) if they change by more, and not `lenient`;
///         EDT002 (Usage) for a joint that moves freely
Result<Motion> with_channels(const Motion& motion, const ChannelOptions& options,
                             Diagnostics& diagnostics);
Result<LongMotion> with_channels(const LongMotion& motion, const ChannelOptions& options,
                                 Diagnostics& diagnostics);

}  // namespace kinefile::shape

#pragma GCC visibility pop
