// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "kinefile/document.hpp"
#include "kinefile/function_ref.hpp"
#include "kinefile/result.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// Whether motions can be read block by block; a page has all bytes of its files anyway.
#ifdef __EMSCRIPTEN__
inline constexpr bool kReadsInBlocks = false;
#else
inline constexpr bool kReadsInBlocks = true;
#endif

/// The frames of a motion, which are read or computed when they are asked for.
struct FrameSource {
  std::size_t num_frames = 0;
  std::size_t num_coordinates = 0;
  /// The values of frames [first, first + count), which exist: [frame][coordinate], valid until the
  /// next call. Called by one thread at a time.
  /// \errors IO001 if they cannot be read any more
  std::function<Result<std::span<const double>>(std::size_t first, std::size_t count)> rows = {};
};

/// A motion that need not fit in memory: the document's clip has a timeline and no frames.
struct LongMotion {
  Document document;
  FrameSource frames;
};

/// Some frames of a source.
struct FrameBlock {
  std::size_t first_frame = 0;
  std::size_t num_frames = 0;
  std::span<const double> rows;  ///< [frame][coordinate]
};

/// Uses some frames; returns false if the output is cut off.
using UseBlock = FunctionRef<bool(const FrameBlock& block)>;

/// Hands all frames of a motion to `use`, block by block: `for_each_block`, or those of a clip.
using EachBlock = FunctionRef<Result<void>(UseBlock use)>;

/// How many frames to ask a source for at a time: a few megabytes.
std::size_t frames_per_read(const FrameSource& frames);

/// Hands all frames to `use`, block by block.
/// \errors those of `FrameSource::rows`; IO003 if `use` returned false
Result<void> for_each_block(const FrameSource& frames, UseBlock use);

/// The same for a clip, whose frames are one block.
Result<void> for_each_block(const Clip& clip, UseBlock use);

}  // namespace kinefile

#pragma GCC visibility pop
