// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinefile/retime.hpp"
#include "retime/frames.hpp"

namespace kinefile::retime {
namespace {

tl::unexpected<Error> refuse_rate(std::string message) {
  return fail(make_error(ErrorKind::Usage, "RTM002", std::move(message)));
}

/// How many new frames there are: one for every whole one up to the end, and the end.
/// \param end  where the old motion ends, in new frames
Result<std::size_t> count_frames(double end) {
  const double last = std::ceil(without_rounding(end));
  if (!(last < kMostFrames)) {
    return refuse_rate(fmt::format("expected at most {} new frames, found {}", kMostFrames, end));
  }
  return static_cast<std::size_t>(last) + 1;
}

/// The map whose new frame n is the old frame n x numerator / denominator, the end included.
Result<TimeMap> map_by_ratio(std::size_t num_old_frames, double numerator, double denominator) {
  TimeMap map;
  if (num_old_frames == 0) return map;
  const auto last_frame = static_cast<double>(num_old_frames - 1);
  const auto count = count_frames(last_frame * denominator / numerator);
  if (!count) return fail(count.error());
  map.old_frames.reserve(*count);
  for (std::size_t n = 0; n + 1 < *count; ++n) {
    // Multiplying first keeps whole frames whole.
    const double old_frame = on_whole_frame(static_cast<double>(n) * numerator / denominator);
    map.old_frames.push_back(std::min(old_frame, last_frame));
  }
  map.old_frames.push_back(last_frame);
  return map;
}

/// The old frame, fractions included, at a time, where frames have times of their own.
/// \param times  rising, two or more
double frame_at_time(const std::vector<double>& times, double time) {
  const auto after = std::upper_bound(times.begin() + 1, times.end() - 1, time);
  const double start = *(after - 1);
  const double share = *after > start ? (time - start) / (*after - start) : 0;
  return static_cast<double>(after - times.begin() - 1) + std::clamp(share, 0.0, 1.0);
}

/// The map whose new frame n is n x step seconds after the first, the end included.
Result<TimeMap> map_by_times(const std::vector<double>& times, double step) {
  TimeMap map;
  const auto is_bad = [](double time) { return !std::isfinite(time); };
  if (std::any_of(times.begin(), times.end(), is_bad) ||
      !std::is_sorted(times.begin(), times.end())) {
    return refuse_rate("expected frames whose times rise, found others");
  }
  const auto count = count_frames((times.back() - times.front()) / step);
  if (!count) return fail(count.error());
  map.old_frames.reserve(*count);
  for (std::size_t n = 0; n + 1 < *count; ++n) {
    map.old_frames.push_back(frame_at_time(times, times.front() + static_cast<double>(n) * step));
  }
  map.old_frames.push_back(static_cast<double>(times.size() - 1));
  return map;
}

bool has_own_times(const Clip& clip) {
  return clip.num_frames > 1 && clip.timeline.times.size() == clip.num_frames;
}

bool is_positive(double value) { return value > 0 && std::isfinite(value); }

}  // namespace

Result<TimeMap> resample_map(const Clip& clip, double frame_rate) {
  if (!is_positive(frame_rate)) {
    return refuse_rate(fmt::format("expected a frame rate above 0, found {}", frame_rate));
  }
  const double old_rate = nominal_frame_rate(clip.timeline);
  if (!has_own_times(clip) && !is_positive(old_rate)) {
    return refuse_rate(fmt::format("expected a motion with a frame rate, found {}", old_rate));
  }
  auto map = has_own_times(clip) ? map_by_times(clip.timeline.times, 1 / frame_rate)
                                 : map_by_ratio(clip.num_frames, old_rate, frame_rate);
  if (map) {
    map->timeline =
        Timeline{Timeline::Given::FrameRate, frame_rate, clip.timeline.first_frame_number, {}};
  }
  return map;
}

Result<TimeMap> speed_map(const Clip& clip, double speed) {
  if (!is_positive(speed)) {
    return refuse_rate(fmt::format("expected a speed above 0, found {}", speed));
  }
  if (!has_own_times(clip)) return map_by_ratio(clip.num_frames, speed, 1);
  const double step = frame_time(clip.timeline) * speed;
  if (!is_positive(step)) {
    return refuse_rate(
        fmt::format("expected a motion with a frame time, found {}", frame_time(clip.timeline)));
  }
  auto map = map_by_times(clip.timeline.times, step);
  if (map) {
    map->timeline = clip.timeline;
    map->timeline->times.clear();
  }
  return map;
}

}  // namespace kinefile::retime
