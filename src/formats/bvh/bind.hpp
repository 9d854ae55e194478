// SPDX-License-Identifier: MIT
#pragma once

#include "formats/bvh/syntax.hpp"
#include "kinefile/bvh.hpp"
#include "kinefile/diagnostics.hpp"
#include "kinefile/format.hpp"
#include "kinefile/motion.hpp"
#include "kinefile/result.hpp"

namespace kinefile::bvh {

/// Tells how the position channels of a file seem to be meant, from the first frames.
struct PositionGuess {
  PositionMode mode = PositionMode::Replace;
  bool is_known = false;  ///< some joint has an OFFSET and a position channel that tell
  std::string reason;     ///< for a message
};
PositionGuess guess_positions(const File& file);

/// Gives a file its meaning. The values are moved, not copied.
/// \param mode  Replace or Add
Motion bind(File&& file, PositionMode mode);

/// The file that a motion is written as, without its values. Points into `skeleton`.
struct Unbound {
  File file;
  /// The clip's column for every column of the file; empty where they are the same.
  std::vector<std::size_t> column_of;
};

/// Finds the BVH form of a skeleton: the opposite of `bind`.
/// \errors BVH036 if a joint moves in a way that BVH has no words for
Result<Unbound> unbind(const Skeleton& skeleton);

}  // namespace kinefile::bvh
