// SPDX-License-Identifier: MIT
#include "kinefile/clip.hpp"

namespace kinefile {

bool is_always(const Clip& clip, std::size_t column, double value) {
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    if (clip.row(f)[column] != value) return false;
  }
  return true;
}

Clip with_columns(const Clip& clip, const std::vector<std::size_t>& columns) {
  Clip result;
  result.num_frames = clip.num_frames;
  result.num_coordinates = columns.size();
  result.timeline = clip.timeline;
  result.values.reserve(clip.num_frames * columns.size());
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    for (const std::size_t c : columns) result.values.push_back(clip.row(f)[c]);
  }
  return result;
}

}  // namespace kinefile
