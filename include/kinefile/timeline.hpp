// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#pragma GCC visibility push(default)

namespace kinefile {

/// Frames that are equally far apart, by the time from one to the next.
struct FrameTime {
  double seconds = 1.0 / 30;
  bool operator==(const FrameTime&) const = default;
};

/// Frames that are equally far apart, by how many there are in a second.
struct FrameRate {
  double per_second = 30;
  bool operator==(const FrameRate&) const = default;
};

/// Frames that have times of their own.
struct FrameTimes {
  std::vector<double> seconds;  ///< one a frame, each above the one before unless the reader was
                                ///< lenient
  std::optional<double> per_second = std::nullopt;  ///< the rate at which the file wants them
                                                    ///< imported, where it gives one
  bool operator==(const FrameTimes&) const = default;
};

/// When the frames of a clip happen, as the file said it.
struct Timeline {
  std::variant<FrameTime, FrameRate, FrameTimes> given = FrameTime{};
  std::int64_t first_frame_number = 0;  ///< what the file calls its first frame; we count from 0
  bool operator==(const Timeline&) const = default;
};

/// The frames' own times; none where the frames are equally far apart.
const std::vector<double>& own_times(const Timeline& timeline);

/// Whether the frames have times of their own.
bool has_own_times(const Timeline& timeline);

/// Whether frames of one number happen at one time in both: at one rate, or at the same own times.
bool have_same_times(const Timeline& a, const Timeline& b);

/// Seconds from one frame to the next; of frames with own times 1 / `frame_rate`.
double frame_time(const Timeline& timeline);

/// Frames a second; of frames with own times the rate at which the file wants them imported, else
/// their `steady_rate`, else 0.
double frame_rate(const Timeline& timeline);

/// Frames a second, meant rather than written: a frame time with three digits or more that was cut
/// off or rounded from that of a whole rate (0.0083333), or of 24, 30, 60 or 120 by 1.001, stands
/// for that rate. Otherwise as `frame_rate`.
double nominal_frame_rate(const Timeline& timeline);

/// A rate for frames that have times of their own.
struct SteadyRate {
  double per_second = 0;
  bool holds_times = false;  ///< every time is that of a frame, to its last digit
};

/// The lowest of the rates 1, 2, 5, 10, 20, 24, 25, 30, 50, 60, 100, 120, 200, 240, 250, 500 and
/// 1000 whose frames, counted from 0 s, hold every time within half a unit of the last digit of its
/// shortest decimal form, no two times in one frame; else 1 / `median_step`. Nothing if the times
/// do not rise or are not finite.
std::optional<SteadyRate> steady_rate(std::span<const double> times);

/// The frame at this rate that holds a time, counted from 0 s (see `steady_rate`), or nothing.
std::optional<double> frame_that_holds(double time, double frame_rate);

/// The median of the steps from one time to the next, the lower one of two; 0 where there is none.
double median_step(std::span<const double> times);

/// The time of a frame in seconds: frame x frame time, never accumulated; or the frame's own time.
/// After the last frame own times go on by their median step.
double time_of_frame(const Timeline& timeline, std::size_t frame);

/// The last frame that begins at or before a time, and how far the time is on the way to the next.
struct FramePosition {
  std::size_t frame = 0;
  double share = 0;  ///< in [0, 1)
};

/// Where a time lies among the times of frames, which rise; before them at the first, after them at
/// the last.
FramePosition position_in_time(std::span<const double> times, double seconds);

/// The frame at a time in seconds, fractions included, by `nominal_frame_rate` or among the own
/// times; the whole one where only the rounding of the arithmetic is missing. Before the first and
/// after the last frame own times go on by their median step.
double frame_at_time(const Timeline& timeline, double seconds);

/// The time from the first frame to the last, in seconds; 0 without frames.
double duration(const Timeline& timeline, std::size_t num_frames);

}  // namespace kinefile

#pragma GCC visibility pop
