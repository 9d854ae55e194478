// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/motion.hpp"
#include "kinefile/result.hpp"

namespace kinefile {

/// The same motion of a skeleton whose joints have the world's axes in the rest pose: offsets,
/// axes and tips are turned, rest rotations become none. Values stay as they are, bit for bit.
/// \errors BRG001 (DataLoss) if a joint that moves freely has a rest rotation
Result<Motion> with_world_aligned_rest(const Motion& motion);

/// The same motion without movements along bones (ASF `l`): the children of such a joint move in
/// its place, by the same columns.
/// \errors BRG002 (DataLoss) if a tip moves, which has no children to do so, and not `lenient`
Result<Motion> without_tail_translations(const Motion& motion, bool lenient,
                                         Diagnostics& diagnostics);

/// The same motion without columns that no degree of freedom reads.
Motion without_unread_columns(const Motion& motion);

/// The same motion without tips where a child sits: the inner ends of bones.
Motion without_inner_tips(const Motion& motion);

/// The same motion of a skeleton of bones, as ASF has it: one root called "root", and joints each
/// of which has one tip, its end, where all of its children sit. Where children sit in several
/// places, or a joint has several tips, bones without degrees of freedom lead there, named
/// JOINT_to_CHILD and JOINT_end. A root of another name becomes a bone of no length on the root.
/// Positions of other joints are told from the rest pose on, so that all coordinates rest at 0;
/// those that never leave it are left out. Names that ASF could not hold are changed.
/// What was added, changed or left out is told in notes; positions of joints stay.
/// \errors BRG003 (DataLoss) if there are several roots, or joints are scaled, or move freely
Result<Motion> with_bones(const Motion& motion, bool lenient, Diagnostics& diagnostics);

/// Puts a motion on another skeleton, joint by joint of the same name, whatever its case: the
/// rotations, as far as the other skeleton's degrees of freedom go, and the positions of roots.
/// Rotations count from the rest poses, in which both are taken to stand alike.
/// Joints that are missing on either side, and turns that cannot be made, are told in warnings.
/// \errors BRG004 (Usage) if no joint has the name of another, or one moves freely
Result<Motion> onto_skeleton(const Motion& motion, const Skeleton& skeleton,
                             Diagnostics& diagnostics);

}  // namespace kinefile
