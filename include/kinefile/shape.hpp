// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "kinefile/motion.hpp"
#include "kinefile/result.hpp"

#pragma GCC visibility push(default)

namespace kinefile::shape {

/// The axes of three rotations, outermost first: 0 x, 1 y, 2 z. "ZXY" is {2, 0, 1}.
using RotationOrder = std::array<std::size_t, 3>;

/// The same motion in which every value of a degree of freedom is its column's number: gains are 1
/// and shifts 0. A joint that follows another by them, or that has a column of its own beside (see
/// `following_columns`), gets its values in a column of its own.
Motion with_plain_values(const Motion& motion);

/// The same motion with three rotations in the place of each ball and each rotation vector; angles
/// go on from the frame before. Joints that move freely stay.
Motion with_angles(const Motion& motion, const RotationOrder& order);

/// The same motion of a skeleton whose joints have the world's axes in the rest pose: offsets,
/// axes and tips are turned, rest rotations become none. Values stay as they are, bit for bit.
/// \errors BRG001 (DataLoss) if a joint that moves freely or turns in any way (a ball, a rotation
///         vector) has a rest rotation, or one above it has
Result<Motion> with_world_aligned_rest(const Motion& motion);

/// The same motion without movements along bones (ASF `l`): the children of such a joint move in
/// its place, by the same columns.
/// \errors BRG002 (DataLoss) if a tip moves where no child sits, which would do so, and not
///         `lenient`
Result<Motion> without_tail_translations(const Motion& motion, bool lenient,
                                         Diagnostics& diagnostics);

/// The same motion without columns that no degree of freedom reads.
Motion without_unread_columns(const Motion& motion);

/// The same motion without tips where a child sits: the inner ends of bones.
Motion without_inner_tips(const Motion& motion);

/// The same motion of a skeleton of bones, as ASF has it: one root called "root", and joints each
/// of which has one tip, its end, where all of its children sit. Where children sit in several
/// places, or a joint has several tips, helper bones lead there: they have no degrees of freedom
/// and names that end in `_kf_helper`, behind the name of the child, of the tip, or JOINT_end. A
/// root of another name gets a helper of that name as its first bone, or a bone of that name if it
/// moves its tail. `without_helper_bones` is the way back. Positions of other joints are told from
/// the rest pose on, so that all coordinates rest at 0; those that never leave it are left out.
/// Names that ASF could not hold are changed. Joints below the root that rest turned get the
/// world's axes (see `with_world_aligned_rest`). Balls and rotation vectors become angles about z,
/// y and x, gains and shifts values (see `with_angles`, `with_plain_values`). What was added,
/// changed or left out is told in notes; positions of joints stay. \errors BRG003 (DataLoss) if
/// there are several roots, or joints are scaled, or move freely
Result<Motion> with_bones(const Motion& motion, bool lenient, Diagnostics& diagnostics);

/// The same motion without the helper bones that `with_bones` adds: joints below a root whose names
/// end in `_kf_helper`, without degrees of freedom, columns and rest rotations. What hangs on them
/// hangs on the joint above, by the sum of the offsets; a tip that they lead to becomes that
/// joint's; a root called "root" gets the name that its first bone keeps, if no joint has it.
/// Everything else stays as it is, every value too. A note tells what was taken out.
Motion without_helper_bones(Motion motion, Diagnostics& diagnostics);

/// Puts a motion on another skeleton, joint by joint of the same name (its case counts only where
/// two joints differ by case alone); the first joints of both belong together whatever their names.
/// Rotations, translations and tails count from the rest poses, in which both are taken to stand
/// alike, roots go where the other's are; all as far as the other skeleton's degrees of freedom go.
/// Where both joints do the same by the same values, these are copied, bit for bit.
/// Joints that are missing on either side, and what cannot be done, are told in warnings.
/// \errors BRG004 (Usage) if no joint has the name of another, or one moves freely
Result<Motion> onto_skeleton(const Motion& motion, const Skeleton& skeleton,
                             Diagnostics& diagnostics);

/// Reads an order of rotations, in any case: three of x, y and z of which no neighbours are equal.
std::optional<RotationOrder> parse_rotation_order(std::string_view text);

/// Which joints have channels of their own for position.
enum class PositionChannels {
  AsIs,  ///< those that have them
  Root,  ///< roots alone; every joint turns about three axes
  All,   ///< every joint; every joint turns about three axes
};

struct ChannelOptions {
  std::optional<RotationOrder> order =
      std::nullopt;  ///< absent: each joint's own, or `usual_order` where it has none
  RotationOrder usual_order = {2, 0, 1};
  PositionChannels positions = PositionChannels::AsIs;
  bool adds_positions = false;  ///< new position channels are added to offsets, not in their place;
                                ///< as the motion's own are, if it has any that tell
  bool replaces_offsets = false;  ///< positions are to stand in the place of offsets, whatever the
                                  ///< motion's own do
  bool distinct_axes = false;     ///< joints that turn twice about one axis get `usual_order`
  bool lenient = false;           ///< drop positions that change, with a warning
};

/// Whether a joint turns twice about one axis, as in the order ZXZ.
bool repeats_an_axis(const Joint& joint);

/// Gives a motion other channels for the same movement: the world stays as it is.
/// Joints whose rotations have the order already keep every bit; the others' angles are found
/// anew, each nearest to the frame before, so that curves stay continuous. With `AsIs`, a joint
/// with one rotation, or with some in the order's sequence, keeps them. Joints that turn about or
/// move along other axes than x, y and z, or share columns, get rotations and positions of their
/// own about and along these. Balls and rotation vectors get angles, values that a gain or a shift
/// makes get columns of their own.
/// A joint that loses its position channels gets them into its offset where they do not change.
/// \errors EDT001 (DataLoss) if they do change, and not `lenient`;
///         EDT002 (Usage) for a joint that moves freely
Result<Motion> with_channels(const Motion& motion, const ChannelOptions& options,
                             Diagnostics& diagnostics);

}  // namespace kinefile::shape

#pragma GCC visibility pop
