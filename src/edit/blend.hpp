// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "kinefile/motion.hpp"

namespace kinefile::edit {

/// Moves and turns a motion on the ground so that its first root that moves is, in `frame`, over
/// the same point and heads the same way as in `other_frame` of another motion. It is turned only
/// if all roots can turn in any way.
/// \param other  of the same skeleton
Motion moved_to(Motion motion, std::size_t frame, const Motion& other, std::size_t other_frame);

/// Fades the poses of some frames into those of another clip: three rotations of a joint as one, as
/// balls and rotation vectors are, other values as numbers.
/// \param to       of the same skeleton; its first frames
/// \param weights  a frame each; 0 leaves the pose as it is, 1 makes it that of `to`; found angles
///                 are the nearest to those of `to`
/// \param first    the first of the frames that change
void fade(const Skeleton& skeleton, const Clip& to, std::span<const double> weights,
          std::size_t first, Clip& clip);

}  // namespace kinefile::edit
