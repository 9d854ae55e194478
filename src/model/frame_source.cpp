// SPDX-License-Identifier: MIT
#include "kinefile/frame_source.hpp"

#include <algorithm>

namespace kinefile {
namespace {

Result<void> cut_off() { return fail(ErrorKind::Io, "IO003", "the output was cut off"); }

}  // namespace

std::size_t frames_per_read(const FrameSource& frames) {
  constexpr std::size_t kMostNumbers = std::size_t{1} << 20;  // 8 MiB
  return std::max<std::size_t>(kMostNumbers / std::max<std::size_t>(frames.num_coordinates, 1), 1);
}

Result<void> for_each_block(const FrameSource& frames, UseBlock use) {
  const std::size_t most = frames_per_read(frames);
  for (std::size_t first = 0; first < frames.num_frames; first += most) {
    const std::size_t count = std::min(most, frames.num_frames - first);
    const auto rows = frames.rows(first, count);
    if (!rows) return fail(rows.error());
    if (!use({first, count, *rows})) return cut_off();
  }
  return {};
}

Result<void> for_each_block(const Clip& clip, UseBlock use) {
  if (!use({0, clip.num_frames, clip.values})) return cut_off();
  return {};
}

}  // namespace kinefile
