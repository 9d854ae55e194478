// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace kinefile {

/// When the frames of a clip happen, as the file said it.
struct Timeline {
  enum class Given {
    FrameTime,  ///< `value` is the seconds from one frame to the next
    FrameRate,  ///< `value` is frames a second
  };
  Given given = Given::FrameTime;
  double value = 1.0 / 30;
  std::int64_t first_frame_number = 0;  ///< what the file calls its first frame; we count from 0
  std::vector<double> times;  ///< seconds, one a frame, where frames carry times of their own
};

/// Seconds from one frame to the next.
double frame_time(const Timeline& timeline);

/// Frames a second.
double frame_rate(const Timeline& timeline);

/// Frames a second, meant rather than written: a frame time with three digits or more that was cut
/// off or rounded from that of a whole rate (0.0083333), or of 24, 30, 60 or 120 by 1.001, stands
/// for that rate. Otherwise as `frame_rate`.
double nominal_frame_rate(const Timeline& timeline);

/// The time of a frame in seconds: frame x frame time, never accumulated; or the frame's own time.
double time_of_frame(const Timeline& timeline, std::size_t frame);

/// The frame at a time in seconds, fractions included, by `nominal_frame_rate`; the whole one where
/// only the rounding of the arithmetic is missing.
double frame_of_time(const Timeline& timeline, double seconds);

/// (frames - 1) x frame time, in seconds; 0 without frames.
double duration(const Timeline& timeline, std::size_t num_frames);

}  // namespace kinefile
