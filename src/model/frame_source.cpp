// SPDX-License-Identifier: MIT
#include "kinefile/frame_source.hpp"

#include <algorithm>

namespace kinefile {

FrameSource frames_of(const Clip& clip) {
  FrameSource frames{clip.num_frames, clip.num_coordinates};
  frames.rows = [&clip](std::size_t first, std::size_t count) -> Result<std::span<const double>> {
    const std::span<const double> values = clip.values;
    return values.subspan(first * clip.num_coordinates, count * clip.num_coordinates);
  };
  return frames;
}

std::size_t frames_per_read(const FrameSource& frames) {
  constexpr std::size_t kMostNumbers = std::size_t{1} << 20;  // 8 MiB
  return std::max<std::size_t>(kMostNumbers / std::max<std::size_t>(frames.num_coordinates, 1), 1);
}

Result<void> for_each_block(const FrameSource& frames,
                            FunctionRef<bool(const FrameBlock& block)> use) {
  const std::size_t most = frames_per_read(frames);
  for (std::size_t first = 0; first < frames.num_frames; first += most) {
    const std::size_t count = std::min(most, frames.num_frames - first);
    const auto rows = frames.rows(first, count);
    if (!rows) return fail(rows.error());
    if (!use({first, count, *rows})) return fail(ErrorKind::Io, "IO003", "the output was cut off");
  }
  return {};
}

}  // namespace kinefile
