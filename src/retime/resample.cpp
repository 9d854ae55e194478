// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinefile/retime.hpp"
#include "retime/frames.hpp"
#include "retime/steady_frames.hpp"

namespace kinefile::retime {
namespace {

tl::unexpected<Error> refuse_rate(std::string message) {
  return fail(make_error(ErrorKind::Usage, "RTM002", std::move(message)));
}

/// The number of new frames: every whole frame up to the end, and the end.
/// \param end  the end of the old motion, in new frames
Result<std::size_t> count_frames(double end) {
  const double last = std::ceil(without_rounding(end));
  if (!(last < kMostFrames)) {
    return refuse_rate(fmt::format("expected at most {} new frames, found {}", kMostFrames, end));
  }
  return static_cast<std::size_t>(last) + 1;
}

Result<TimeMap> map_by_ratio(std::size_t num_old_frames, double numerator, double denominator) {
  TimeMap map;
  if (num_old_frames == 0) return map;
  const auto steady = steady_frames(num_old_frames, numerator, denominator);
  if (!steady) return fail(steady.error());
  map.old_frames.resize(steady->num_frames);
  for (std::size_t n = 0; n < steady->num_frames; ++n) map.old_frames[n] = steady->old_frame(n);
  return map;
}

bool do_rise(std::span<const double> times) {
  const auto is_bad = [](double time) { return !std::isfinite(time); };
  return std::none_of(times.begin(), times.end(), is_bad) &&
         std::is_sorted(times.begin(), times.end());
}

/// The old frame at a time, including a fraction; clamped to the first and the last.
double frame_within(std::span<const double> times, double seconds) {
  const FramePosition position = position_in_time(times, seconds);
  return on_whole_frame(static_cast<double>(position.frame) + position.share);
}

/// The map whose new frame n is n / rate seconds after `start`, the end included.
Result<TimeMap> map_by_times(std::span<const double> times, double start, double rate) {
  TimeMap map;
  if (times.empty()) return map;
  if (!do_rise(times)) return refuse_rate("expected frames whose times rise, found others");
  const auto count = count_frames((times.back() - start) * rate);
  if (!count) return fail(count.error());
  map.old_frames.reserve(*count);
  for (std::size_t n = 0; n + 1 < *count; ++n) {
    map.old_frames.push_back(frame_within(times, start + static_cast<double>(n) / rate));
  }
  map.old_frames.push_back(static_cast<double>(times.size() - 1));
  return map;
}

bool is_irregular(const Clip& clip) { return clip.num_frames > 1 && has_own_times(clip.timeline); }

bool is_positive(double value) { return value > 0 && std::isfinite(value); }

}  // namespace

double SteadyFrames::old_frame(std::size_t new_frame) const {
  const auto last_frame = static_cast<double>(num_old_frames - 1);
  if (new_frame + 1 == num_frames) return last_frame;
  // Multiplying first keeps whole frames whole.
  const double place = static_cast<double>(new_frame) * numerator / denominator;
  return std::min(on_whole_frame(place), last_frame);
}

Result<SteadyFrames> steady_frames(std::size_t num_old_frames, double numerator,
                                   double denominator) {
  const auto last_frame = static_cast<double>(num_old_frames - 1);
  const auto count = count_frames(last_frame * denominator / numerator);
  if (!count) return fail(count.error());
  return SteadyFrames{num_old_frames, *count, numerator, denominator};
}

Result<TimeMap> resample_map(const Clip& clip, double frame_rate) {
  if (!is_positive(frame_rate)) {
    return refuse_rate(fmt::format("expected a frame rate above 0, found {}", frame_rate));
  }
  const double old_rate = nominal_frame_rate(clip.timeline);
  if (!is_irregular(clip) && !is_positive(old_rate)) {
    return refuse_rate(fmt::format("expected a motion with a frame rate, found {}", old_rate));
  }
  const Array<double>& times = own_times(clip.timeline);
  auto map = is_irregular(clip) ? map_by_times(times, times.front(), frame_rate)
                                : map_by_ratio(clip.num_frames, old_rate, frame_rate);
  if (map) map->timeline = Timeline{FrameRate{frame_rate}, clip.timeline.first_frame_number};
  return map;
}

Result<TimeMap> speed_map(const Clip& clip, double speed) {
  if (!is_positive(speed)) {
    return refuse_rate(fmt::format("expected a speed above 0, found {}", speed));
  }
  if (!is_irregular(clip)) return map_by_ratio(clip.num_frames, speed, 1);
  const double rate = frame_rate(clip.timeline);
  if (!is_positive(rate / speed)) {
    return refuse_rate(fmt::format("expected a motion with a frame rate, found {}", rate));
  }
  const Array<double>& times = own_times(clip.timeline);
  auto map = map_by_times(times, times.front(), rate / speed);
  if (map) map->timeline = Timeline{FrameRate{rate}, clip.timeline.first_frame_number};
  return map;
}

Result<TimeMap> steady_map(const Clip& clip, double frame_rate, double start) {
  if (!is_positive(frame_rate)) {
    return refuse_rate(fmt::format("expected a frame rate above 0, found {}", frame_rate));
  }
  if (!std::isfinite(start)) {
    return refuse_rate(fmt::format("expected a time to begin at, found {} s", start));
  }
  // If a frame matches a time, it shows exactly that time's frame, in spite of rounding in the
  // time.
  Array<double> times = own_times(clip.timeline);
  const bool is_whole = frame_rate == std::round(frame_rate);
  const auto held = [frame_rate](double time) { return frame_that_holds(time, frame_rate); };
  const bool holds_all = is_whole && held(start) && std::all_of(times.begin(), times.end(), held);
  for (double& time : times.mutate()) time = holds_all ? *held(time) : time;
  auto map =
      holds_all ? map_by_times(times, *held(start), 1) : map_by_times(times, start, frame_rate);
  if (map) map->timeline = Timeline{FrameRate{frame_rate}, clip.timeline.first_frame_number};
  return map;
}

Result<SteadyRate> rate_for(const Timeline& timeline) {
  const FrameTimes* own = std::get_if<FrameTimes>(&timeline.given);
  if (own == nullptr || own->per_second) return SteadyRate{frame_rate(timeline), true};
  const auto steady = steady_rate(own->seconds);
  if (!steady) return refuse_rate("expected frames whose times rise, found others");
  return *steady;
}

Result<Motion> with_steady_rate(const Motion& motion, double frame_rate, double start,
                                const RetimeOptions& options, Diagnostics& diagnostics) {
  if (!has_own_times(motion.clip.timeline)) return motion;
  const auto map = steady_map(motion.clip, frame_rate, start);
  if (!map) return fail(map.error());
  return apply(motion, *map, options, diagnostics);
}

}  // namespace kinefile::retime
