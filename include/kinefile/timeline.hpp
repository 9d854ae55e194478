// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "kinefile/array.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// Frames at equal intervals, given by the time from one to the next.
struct FrameTime {
  double seconds = 1.0 / 30;
  bool operator==(const FrameTime&) const = default;
};

/// Frames at equal intervals, given by the number of frames per second.
struct FrameRate {
  double per_second = 30;
  bool operator==(const FrameRate&) const = default;
};

/// Frames that have their own times.
struct FrameTimes {
  Array<double> seconds;  ///< one per frame, strictly increasing unless the reader was
                          ///< lenient
  std::optional<double> per_second = std::nullopt;  ///< the import rate that the file specifies, if
                                                    ///< any
  bool operator==(const FrameTimes&) const = default;
};

/// The times of a clip's frames, as given in the file.
struct Timeline {
  std::variant<FrameTime, FrameRate, FrameTimes> given = FrameTime{};
  std::int64_t first_frame_number = 0;  ///< the file's number of its first frame; kinefile counts
                                        ///< from 0
  bool operator==(const Timeline&) const = default;
};

/// The frames' own times; empty if the frames are at equal intervals.
const Array<double>& own_times(const Timeline& timeline);

/// Whether the frames have their own times.
bool has_own_times(const Timeline& timeline);

/// Whether frames with the same number have the same time in both: the same rate (see
/// `have_same_rate`), or the same own times.
bool have_same_times(const Timeline& a, const Timeline& b);

/// Whether two rates are the same but for the spelling of their frame times (0.0333333 s, 0.033333
/// s, 30 fps): their `frame_rate` or their `nominal_frame_rate` agree within a part in 100,000, a
/// frame in an hour at 30 fps. Rates in use differ by a part in 1000 at least (30 and 29.97).
bool have_same_rate(const Timeline& a, const Timeline& b);

/// Seconds from one frame to the next; for frames with their own times 1 / `frame_rate`.
double frame_time(const Timeline& timeline);

/// Frames per second; for frames with their own times the import rate that the file specifies,
/// otherwise their `steady_rate`, otherwise 0.
double frame_rate(const Timeline& timeline);

/// The intended number of frames per second: a frame time with three digits or more that was
/// truncated or rounded from that of a whole rate (0.0083333), or of 24, 30, 60 or 120 divided by
/// 1.001, stands for that rate. So does one within a part in 100,000 of that of a whole rate up to
/// 1000 (0.03333323). Otherwise as `frame_rate`.
double nominal_frame_rate(const Timeline& timeline);

/// The usual whole numbers of frames per second, rising: 1, 2, 5, 10, 20, 24, 25, 30, 50, 60, 100,
/// 120, 200, 240, 250, 500 and 1000.
std::span<const double> usual_rates();

/// The rates of television, rising: 24, 30, 60 and 120 divided by 1.001.
std::span<const double> television_rates();

/// A steady rate for frames that have their own times.
struct SteadyRate {
  double per_second = 0;
  bool holds_times = false;  ///< every time is that of a frame, within the precision of its last
                             ///< digit
};

/// The lowest of the `usual_rates` whose frames, counted from 0 s, match every time within half a
/// unit of the last digit of its shortest decimal form, with no two times in one frame; otherwise 1
/// / `median_step`. Nothing if the times are not increasing or not finite.
std::optional<SteadyRate> steady_rate(std::span<const double> times);

/// The frame at this rate, counted from 0 s, that matches a time (see `steady_rate`), or nothing.
std::optional<double> frame_that_holds(double time, double frame_rate);

/// The median of the steps from one time to the next, the lower of the two middle ones if their
/// number is even; 0 if there are no steps.
double median_step(std::span<const double> times);

/// The time of a frame in seconds: frame x frame time, never accumulated; or the frame's own time.
/// After the last frame, own times continue by their median step.
double time_of_frame(const Timeline& timeline, std::size_t frame);

/// The last frame at or before a time, and the time's relative position between it and the next.
struct FramePosition {
  std::size_t frame = 0;
  double share = 0;  ///< in [0, 1)
};

/// The position of a time among increasing times of frames; clamped to the first and the last
/// frame.
FramePosition position_in_time(std::span<const double> times, double seconds);

/// The frame at a time in seconds, including a fraction, by `nominal_frame_rate` or the own times.
/// Rounded to a whole number if it differs by arithmetic rounding only. Before the first and after
/// the last frame, own times continue by their median step.
double frame_at_time(const Timeline& timeline, double seconds);

/// The time from the first frame to the last, in seconds; 0 without frames.
double duration(const Timeline& timeline, std::size_t num_frames);

}  // namespace kinefile

#pragma GCC visibility pop
