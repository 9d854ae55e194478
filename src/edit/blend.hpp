// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kinefile/motion.hpp"

namespace kinefile::edit {

/// Moves and turns a motion on the ground so that its first root that moves is, in `frame`, over
/// the same point and heads the same way as in `other_frame` of another motion. It is turned only
/// if all roots turn about three axes or move freely.
/// \param other  of the same skeleton
Motion moved_to(const Motion& motion, std::size_t frame, const Motion& other,
                std::size_t other_frame);

/// Fades one pose into another: three rotations of a joint as one, other values as numbers.
class Blender {
 public:
  explicit Blender(const Skeleton& skeleton);

  /// \param to      the pose to fade into; found angles are the nearest to its angles
  /// \param weight  0 leaves `row` as it is, 1 makes it `to`
  void blend(std::span<const double> to, double weight, std::span<double> row) const;

 private:
  struct Turn {
    std::vector<DegreeOfFreedom> rotations;  ///< three, outermost first; none if it moves freely
    std::size_t free_column = 0;
  };

  AngleUnit unit_;
  std::vector<bool> is_angle_;  ///< columns that come round after a whole turn
  std::vector<Turn> turns_;
};

}  // namespace kinefile::edit
