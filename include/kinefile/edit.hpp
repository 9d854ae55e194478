// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kinefile/document.hpp"
#include "kinefile/frame_source.hpp"
#include "kinefile/motion.hpp"
#include "kinefile/result.hpp"

/// Operations that take a motion by value change it in place if no other motion shares its clip:
/// pass it with std::move. Other operations do not change their arguments.
#pragma GCC visibility push(default)

namespace kinefile::edit {

/// The frames from `begin` to `end`, `end` not included, bit for bit. The file's own number of the
/// first frame is adjusted. Frames keep their own times.
/// \errors EDT003 (Usage) if the motion does not have these frames
Result<Motion> trim(const Motion& motion, std::size_t begin, std::size_t end);

/// The frames from the last to the first, bit for bit. Frames' own times start at the same time and
/// keep their intervals, in reverse order.
Motion reverse(Motion motion);

/// The mirrored motion: the right side does what the left side did, and vice versa. The skeleton
/// stays the same, even if its halves differ. The plane of the mirror stands in the world and
/// contains the origin; the pairing belongs to the skeleton. Joints are paired by name (Left/Right
/// and 左/右 anywhere, l/r and L/R as words or as the first or last letter of a word, if such a
/// joint exists at the same depth). Other joints are paired by the places of joints and tips in the
/// rest pose, with tolerances relative to the skeleton's size: a joint within 1/1000 of the plane
/// through its root is its own image; a joint whose image lies within 1/100 of another joint is
/// paired with it; a remaining joint within 1/100 of the plane is its own image. If the rest pose
/// is not symmetric, the most symmetric of 64 frames takes its place, if one is (EDT012). A joint
/// on the trunk that has nobody on the other side is its own image if other joints are paired.
/// Values of axes that are each other's mirror images are copied bit for bit, with a change of sign
/// where needed. Other angles are recomputed, each nearest to the previous frame.
/// \param axis  0 x, 1 y, 2 z: the normal of the mirror in the world; absent: the horizontal axis
///              along which the halves lie
/// \errors EDT004 (Usage) if the axis points up, a moving joint has no partner, its partner cannot
///         move as it does, or the halves lie on the two sides of no plane; with `lenient` all but
///         the first are mirrored as far as possible, with a warning
Result<Motion> mirror(const Motion& motion, std::optional<std::size_t> axis, bool lenient,
                      Diagnostics& diagnostics);

/// All lengths times a factor: offsets, tips, shapes, positions. The factor is above 0.
Motion scale(Motion motion, double factor);

/// The same motion in coordinates in which another axis points up: rotated by 90 degrees.
/// The skeleton's offsets and axes are rotated too, so that values stay the same bit for bit. Only
/// where an axis would point along -x, -y or -z, the axis is reversed and its column changes sign.
/// A change to z and back to y restores the same skeleton and the same bits, rotations of shapes
/// but for rounding. If that axis points up already (see `find_up_axis`), nothing changes and a
/// note (EDT009) reports it. From then on the axis is known (`Skeleton::up`). \param axis  1 for y,
/// 2 for z
Motion up(Motion motion, std::size_t axis, Diagnostics& diagnostics);

/// The same for a motion whose frames are read when they are asked for; so are the new ones.
/// Precondition: the axis that points up is known (`Skeleton::up`), and another one.
LongMotion up(const LongMotion& motion, std::size_t axis);

/// The motion in place: the joints that carry it (see `find_travellers`) stay above their start
/// positions on the ground. Columns along the axis that points up (see `settle_up_axis`) keep every
/// bit.
Motion in_place(Motion motion, Diagnostics& diagnostics);

/// The motion repeated `count` times. Frames' own times continue after their median step (see
/// `median_step`). Without blending every bit is kept, and the figure jumps back to its start; with
/// blending see `append`.
/// \errors EDT005 (Usage) as for `append`, if `count` is 0, or if the result would be too large
Result<Motion> loop(const Motion& motion, std::size_t count, std::size_t num_blend_frames,
                    Diagnostics& diagnostics, bool is_moved = true);

/// One motion followed by another. Without blending every bit is kept. With blending, the second
/// motion is translated and rotated on the ground so that in the middle of the overlap the joint
/// that carries it (see `find_travellers`) coincides with that of the first; the ground is level
/// with the axis that points up (see `settle_up_axis`). The last frames of the first are blended
/// (3u^2 - 2u^3) into the first frames of the second. The second is rotated only if all such joints
/// turn about three axes, move freely or are points. The skeletons must have the same names,
/// parents, degrees of freedom and columns, and offsets within 1e-4 of the skeleton's size: those
/// of the first are used, and a difference beyond 1e-6 gives a note (EDT014). Rest values may
/// differ. Frame rates must agree (see `have_same_rate`) unless frames have their own times, which
/// go on after the median step of the first.
/// \param is_moved  false for numbers that are no places in the world, such as values of joints:
///                  they are blended as they are
/// \errors EDT005 (Usage) if the skeletons or frame rates differ, one has fewer frames than are to
///         be blended, or the result would have more than 2^30 values
Result<Motion> append(Motion first, const Motion& second, std::size_t num_blend_frames,
                      Diagnostics& diagnostics, bool is_moved = true);

/// The motion of some joints and all their ancestors, which keep their positions in the world. A
/// joint that loses all children and has no tip gets tips where they were; a child that was
/// translated gives a warning (EDT010). Shapes of removed joints that cannot move go to the joint
/// that remains above them. The columns of removed joints are removed unless a remaining joint
/// reads them.
/// \param names  case is ignored unless two joints differ by case alone; `*` stands for any
///               characters
/// \errors EDT006 (Usage) if no joint has a given name
Result<Motion> joints(const Motion& motion, std::span<const std::string> names,
                      Diagnostics& diagnostics);

/// Renames a joint, in the skeleton and in what its format keeps. If several joints have the name,
/// all of them are renamed.
/// \errors EDT006 (Usage) if no joint has the old name, or the new name is empty or that of another
///         joint; DOC001 (Usage) for a document without a skeleton
Result<void> rename(Document& document, const std::string& old_name, const std::string& new_name);

/// The motion after a low-pass filter: a second-order Butterworth filter, run forwards and
/// backwards, so that nothing is delayed. Three rotations of a joint are filtered as quaternions
/// that are continuous in time; other values as numbers. Jumps of angles by whole turns do not
/// affect the filter. Both ends are extended by reflection over two periods of the cut-off. Values
/// that do not change over time keep every bit.
/// \param cutoff_hz  the frequency at which both passes together halve the power; above 0, below
///                   half the frame rate
/// \errors EDT007 (Usage) if the cut-off is out of range, EDT011 (Usage) for frames with their own
///         times, because the filter needs equal intervals (see `retime::resample_map`), EDT008
///         (InvalidInput) for values that are not finite
/// Source: Butterworth, Wireless Engineer 7 (1930); Winter, "Biomechanics and Motor Control of
/// Human Movement" (forwards and backwards).
Result<Motion> smooth(Motion motion, double cutoff_hz);

/// The same motion with angles that do not jump. Whole turns are added or subtracted; for three
/// rotations of a joint, the other triple of angles for the same rotation is used if it is nearer
/// to the previous frame; for joints that move freely, the other sign of the quaternion. Values
/// that need no change keep every bit.
Motion unwrap(Motion motion);

}  // namespace kinefile::edit

#pragma GCC visibility pop
