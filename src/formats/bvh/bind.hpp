// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "formats/bvh/positions.hpp"
#include "formats/bvh/syntax.hpp"
#include "kinefile/motion.hpp"
#include "kinefile/result.hpp"

namespace kinefile::bvh {

inline Vec3 vector_of(const std::array<double, 3>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

/// Makes the motion of a file. The values are moved, not copied.
/// \param modes  of every node
Motion bind(File&& file, const PositionModes& modes);

/// The syntax of the file for a motion, without its values. Points into `skeleton`.
struct Unbound {
  File file;
  /// The clip's column for every column of the file; empty if they are the same.
  std::vector<std::size_t> column_of;
};

/// Finds the BVH form of a skeleton: the opposite of `bind`.
/// \errors BVH036 if a joint moves in a way that BVH cannot express
Result<Unbound> unbind(const Skeleton& skeleton);

}  // namespace kinefile::bvh
