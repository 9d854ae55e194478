// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "kinefile/document.hpp"
#include "kinefile/motion.hpp"
#include "kinefile/result.hpp"

/// Operations that take a motion by value change it in place where nobody else looks at its clip:
/// hand it over with std::move. Others leave what they are given as it is.
#pragma GCC visibility push(default)

namespace kinefile::edit {

/// The frames from `begin` to `end`, `end` not included, bit for bit. The file's own number of the
/// first frame moves along; so do frames' own times.
/// \errors EDT003 (Usage) if they are not frames of the motion
Result<Motion> trim(const Motion& motion, std::size_t begin, std::size_t end);

/// The frames from the last to the first, bit for bit; frames with times of their own as far apart
/// as before, from the same time on.
Motion reverse(Motion motion);

/// The motion in a mirror: what the left side did, the right side does. The skeleton stays, even
/// where its halves differ. Joints are paired by name (Left/Right and 左/右 anywhere, l/r and L/R
/// as words or as the first or last letter of one, where there is such a joint at the same depth),
/// others by the rest pose: a joint within 1/1000 of the skeleton's size of the plane through its
/// root is its own image, one whose image lies within 1/100 of another's is paired with that, and
/// what is left is its own image within 1/100 of the plane.
/// Values of axes that are each other's mirror images are copied, with a change of sign where there
/// must be one, bit for bit; other angles are found anew, each nearest to the frame before.
/// \param axis  0 x, 1 y, 2 z: the normal of the mirror, which goes through the origin; see
///              `guess_mirror_axis`
/// \errors EDT004 (Usage) if a joint that moves has no other half, or the other half cannot move as
///         it does, and not `lenient`; then they mirror as they can, with a warning
Result<Motion> mirror(const Motion& motion, std::size_t axis, bool lenient,
                      Diagnostics& diagnostics);

/// The axis along which the halves of a skeleton that are paired by name lie apart in the rest
/// pose, most of all: 0 x, 1 y, 2 z. x where no joints are.
std::size_t guess_mirror_axis(const Skeleton& skeleton);

/// All lengths times a factor: offsets, tips, positions. The factor is above 0.
Motion scale(Motion motion, double factor);

/// The same motion in coordinates in which another axis points up: turned about x by a quarter.
/// The skeleton's offsets and axes turn along, so that angles stay as they are: every bit but the
/// sign of columns whose axis would come to point along -x, -y or -z, which is turned around. To z
/// and back to y is the same skeleton and the same bits.
/// With a note (EDT009) and no change if that axis points up already (see `guess_up_axis`).
/// \param axis  1 for y, 2 for z
Motion up(Motion motion, std::size_t axis, Diagnostics& diagnostics);

/// The motion on the spot: every root stays over the place on the ground where it starts. Columns
/// along the axis that points up (see `guess_up_axis`) keep every bit.
Motion in_place(Motion motion);

/// The motion `count` times; where frames have times of their own, these go on by their median step
/// (see `median_step`). Without blending every bit is kept, and the figure jumps back to its
/// start; with blending see `append`.
/// \errors EDT005 (Usage) as `append`; or `count` is 0, or the result would be too large
Result<Motion> loop(const Motion& motion, std::size_t count, std::size_t num_blend_frames);

/// One motion and then another. Without blending every bit is kept. With blending the second is
/// moved and turned on the ground so that its root goes on where the first one's is, in the middle
/// of the overlap, and the last frames of the first are faded (3u^2 - 2u^3) into the first frames
/// of the second. It is turned only if all roots turn about three axes or move freely. The
/// skeletons agree if names, parents, degrees of freedom and columns do, and offsets to 1e-6 of the
/// skeleton's size; rest values may differ. Frame rates agree to 1e-6, unless frames have times of
/// their own: these go on, by the median step of the first.
/// \errors EDT005 (Usage) if
/// the skeletons or frame rates differ, one has fewer frames than are
///         to be blended, or the result would have more than 2^30 values
Result<Motion> append(Motion first, const Motion& second, std::size_t num_blend_frames);

/// The motion of some joints and of all joints above them, which keep their places in the world.
/// A joint that loses all children and has no tip gets tips where they were; with a warning
/// (EDT010) if they moved there. Columns go with their joints, unless a joint that stays reads
/// them.
/// \param names  whatever their case where no two joints differ by case alone; `*` stands for any
///               characters
/// \errors EDT006 (Usage) if a name is no joint's
Result<Motion> joints(const Motion& motion, std::span<const std::string> names,
                      Diagnostics& diagnostics);

/// Gives a joint another name, in the skeleton and in what its format keeps of it. Of a name that
/// several joints have, all of them.
/// \errors EDT006 (Usage) if the old name is no joint's, or the new one is another's or empty;
/// DOC001
///         (Usage) for a document without a skeleton
Result<void> rename(Document& document, const std::string& old_name, const std::string& new_name);

/// The motion without what changes faster than a cut-off frequency: a Butterworth filter of second
/// order, run forwards and backwards, so that nothing is delayed. Three rotations of a joint are
/// filtered as quaternions that are continuous in time, other values as numbers, angles among them
/// as if they did not jump by whole turns. Both ends are continued by their reflections for two
/// periods of the cut-off. What does not change keeps every bit.
/// \param cutoff_hz  where both passes together halve the power; above 0, below half the frame rate
/// \errors EDT007 (Usage) for another cut-off, EDT011 (Usage) for frames with times of their own,
///         which the filter would take for equally far apart (`retime::resample_map` makes them
///         so), EDT008 (InvalidInput) for values that are not finite
/// Source: Butterworth, Wireless Engineer 7 (1930); Winter, "Biomechanics and Motor Control of
/// Human Movement" (forwards and backwards).
Result<Motion> smooth(Motion motion, double cutoff_hz);

/// The same motion with angles that do not jump: whole turns, and for three rotations of a joint
/// the other triple for the same rotation, where that is nearer to the frame before; for joints
/// that move freely the other sign of the quaternion. Values that need no change keep every bit.
Motion unwrap(Motion motion);

}  // namespace kinefile::edit

#pragma GCC visibility pop
