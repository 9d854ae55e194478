// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kinefile/motion.hpp"

namespace kinefile::edit {

/// The ground that a figure travels over.
struct Ground {
  std::size_t up = 1;                   ///< the axis that points up
  std::vector<std::size_t> travellers;  ///< see `find_travellers`
};

/// Translates and rotates a motion on the ground so that its first traveller has, in `frame`, the
/// same ground position and heading as in `other_frame` of another motion. It is rotated only if
/// all travellers can represent every rotation or are points.
/// \param other  has the same skeleton
Motion moved_to(Motion motion, std::size_t frame, const Motion& other, std::size_t other_frame,
                const Ground& ground);

/// Blends the poses of some frames into those of another clip: three rotations of a joint as one
/// rotation, like balls and rotation vectors; other values as numbers.
/// \param to       of the same skeleton; its first frames
/// \param weights  one per frame; 0 keeps the pose, 1 gives that of `to`; recomputed angles are the
///                 nearest to those of `to`
/// \param first    the first of the frames that change
void fade(const Skeleton& skeleton, const Clip& to, std::span<const double> weights,
          std::size_t first, Clip& clip);

}  // namespace kinefile::edit
