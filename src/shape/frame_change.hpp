// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

#include "kinefile/frame_source.hpp"
#include "kinefile/motion.hpp"

// A change of a motion is decided from its skeleton, and from what all frames show where that
// counts; then it is made block by block. So motions in memory, which are one block, and motions
// that are read when they are asked for are changed by the same functions.

namespace kinefile::shape {

/// How a motion is changed.
struct FrameChange {
  Skeleton skeleton;  ///< of the changed motion
  /// Makes the next rows of the changed motion from those of the motion, beginning with the first:
  /// angles are near those of the frame before. A copy begins, or goes on, where the original is.
  /// Null: the rows stay as they are.
  std::function<void(const Clip& next, const Rows& rows)> fill = {};
};

Motion changed(const Motion& motion, FrameChange change);

/// The same for a motion whose frames are read when they are asked for; so are its new frames.
/// These are made in their order: one that lies before the last one, or far behind it, takes as
/// long as all frames before it.
LongMotion changed(const LongMotion& motion, FrameChange change);

inline const Skeleton& skeleton_in(const Motion& motion) { return motion.skeleton; }
inline const Skeleton& skeleton_in(const LongMotion& motion) {
  return skeleton_of(motion.document);
}

inline std::size_t num_frames_of(const Motion& motion) { return motion.clip.num_frames; }
inline std::size_t num_frames_of(const LongMotion& motion) { return motion.frames.num_frames; }

inline Result<void> for_each_block_of(const Motion& motion, UseBlock use) {
  return for_each_block(motion.clip, use);
}
inline Result<void> for_each_block_of(const LongMotion& motion, UseBlock use) {
  return for_each_block(motion.frames, use);
}

/// The frames of a block as a clip without a timeline, which is valid as long as they are.
Clip clip_of(const FrameBlock& block, std::size_t num_coordinates);

}  // namespace kinefile::shape
