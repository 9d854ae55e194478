// SPDX-License-Identifier: MIT
// A filter over the frames of many numbers at once, which hides that each result waits for the one
// before it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace kinefile::simd {

/// Some numbers of one frame that are worked on together.
struct alignas(64) LaneGroup {
  static constexpr std::size_t kSize = 8;
  double v[kSize] = {};
};

/// Frames of numbers: [frame][group].
struct LaneFrames {
  /// \param most_padding  of a filter: there is room for it behind the frames
  LaneFrames(std::size_t frames, std::size_t groups_of_frame, std::size_t most_padding = 0)
      : num_frames(frames),
        num_groups(groups_of_frame),
        padding(frames == 0 ? 0 : std::min(most_padding, frames - 1)),
        groups((frames + padding) * groups_of_frame) {}

  LaneGroup* frame(std::size_t f) { return groups.data() + f * num_groups; }

  std::size_t num_frames;
  std::size_t num_groups;
  std::size_t padding;
  std::vector<LaneGroup> groups;
};

/// A filter of second order, (b0, 2 b0, b0) over (1, a1, a2), which runs in both directions.
struct LowPass {
  double b0 = 1;
  double a1 = 0;
  double a2 = 0;
  std::size_t padding = 0;  ///< by how many frames numbers are extended at each end; fewer if
                            ///< there are not more
};

/// Filters numbers in place. They are extended at both ends by odd reflection. A number that is the
/// same in all frames keeps every bit.
/// \param frames  with room for the filter's padding
void low_pass(const LowPass& filter, LaneFrames& frames);

/// Gives quaternions the signs by which each is on the side of the one before it.
/// \param frames  four groups a frame: w, x, y and z of as many quaternions as a group has lanes
void take_same_sides(LaneFrames& frames);

}  // namespace kinefile::simd
