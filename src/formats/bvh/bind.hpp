// SPDX-License-Identifier: MIT
#pragma once

#include "formats/bvh/syntax.hpp"
#include "kinefile/bvh.hpp"
#include "kinefile/diagnostics.hpp"
#include "kinefile/format.hpp"
#include "kinefile/motion.hpp"
#include "kinefile/result.hpp"

namespace kinefile::bvh {

/// The probable meaning of a file's position channels, from the first frames.
struct PositionGuess {
  PositionMode mode = PositionMode::Replace;
  bool is_known = false;  ///< some joint has an OFFSET and a position channel that allow a guess
  std::string reason;     ///< for a message
};
PositionGuess guess_positions(const File& file);

/// Makes the motion of a file. The values are moved, not copied.
/// \param mode  Replace or Add
Motion bind(File&& file, PositionMode mode);

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
