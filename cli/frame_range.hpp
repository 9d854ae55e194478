// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace kinefile::cli {

/// Frames from `begin` to `end`, `end` not included, every `step` of them.
struct FrameRange {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t step = 1;

  /// How many frames it holds.
  std::size_t num_frames() const { return (end - begin + step - 1) / step; }
};

/// Reads A:B or A:B:STEP, either end left out at will; all frames for an empty text. Nothing for
/// other texts, and for frames that a motion of so many does not have.
std::optional<FrameRange> parse_range(const std::string& text, std::size_t num_frames);

}  // namespace kinefile::cli
