// SPDX-License-Identifier: MIT
// What files do not say and the motion shows: which axis points up, where the figure faces, its
// unit of length, which joints carry its travel. Each result has a reason.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "kinefile/diagnostics.hpp"
#include "kinefile/motion.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// How certain a result is.
enum class Certainty {
  Known,     ///< the format defines it, or the caller says it
  Clear,     ///< the evidence agrees
  Doubtful,  ///< the evidence is weak, or disagrees
};

/// The axis that points up.
struct UpAxis {
  std::size_t axis = 1;  ///< 0 x, 1 y, 2 z; guesses are y or z
  Certainty certainty = Certainty::Doubtful;
  std::string reason;
};

/// The axis that points up: `Skeleton::up` if it is present. Otherwise y or z, from the evidence of
/// 64 frames and of the rest pose: along it the legs hang down, and the lowest point stays at one
/// height while the figure travels along the other. Legs are found by the names of joints; without
/// them, the height of the joints above the lowest point counts. In doubt y.
UpAxis find_up_axis(const Motion& motion);

/// As `find_up_axis`, for an operation that relies on the axis: a doubtful one gives a note
/// (MOT005).
UpAxis settle_up_axis(const Motion& motion, Diagnostics& diagnostics);

/// A direction on the ground.
struct Facing {
  std::optional<Vec3> direction;  ///< of unit length; absent if nothing shows it
  std::string reason;
};

/// Where the figure faces in a frame: to the left of the line from its right half to its left half,
/// seen from above, which is forward. Halves are paired by the names of joints.
/// \param up  the axis that points up
Facing find_facing(const Motion& motion, std::size_t up, std::size_t frame = 0);

/// How high the figure stands, in its unit of length: the extent along `up` that three of four
/// frames do not exceed, of 64 frames (raised arms and crouching count little); of the rest pose if
/// there are none. 0 if nothing is finite.
double standing_height(const Motion& motion, std::size_t up);

/// The length of a unit.
struct LengthUnit {
  double metres = 1;
  Certainty certainty = Certainty::Doubtful;
  std::string reason;
};

/// The unit of length: `Skeleton::metres_per_unit` if it is above 0. Otherwise the metre; the
/// centimetre if the figure stands higher than 10 units, the millimetre if higher than 500. If it
/// is not 0.5 to 3 m tall then, that is doubtful.
LengthUnit find_length_unit(const Motion& motion);

/// The joints that carry a figure over the ground, in skeleton order: the roots; below a root that
/// does not move, the first joints that travel, if there are any. A joint travels if its position
/// in its parent's frame changes by more than a tenth of the skeleton's size, and at least a
/// quarter of the root's joints are below it.
std::vector<std::size_t> find_travellers(const Motion& motion);

}  // namespace kinefile

#pragma GCC visibility pop
