// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "kinefile/edit.hpp"

namespace kinefile::edit {

Result<Motion> trim(const Motion& motion, std::size_t begin, std::size_t end) {
  const Clip& clip = motion.clip;
  if (begin > end || end > clip.num_frames) {
    return fail(make_error(
        ErrorKind::Usage, "EDT003",
        fmt::format("expected frames within 0:{}, found {}:{}", clip.num_frames, begin, end)));
  }
  Motion result{motion.skeleton, {}};
  result.clip.num_frames = end - begin;
  result.clip.num_coordinates = clip.num_coordinates;
  result.clip.values = Array<double>(
      std::span<const double>(clip.values)
          .subspan(begin * clip.num_coordinates, result.clip.num_frames * clip.num_coordinates));
  Timeline& timeline = result.clip.timeline;
  timeline = clip.timeline;
  timeline.first_frame_number += static_cast<std::int64_t>(begin);
  if (FrameTimes* own = std::get_if<FrameTimes>(&timeline.given)) {
    const std::span<const double> times = own_times(clip.timeline);
    own->seconds = Array<double>(times.subspan(begin, end - begin));
  }
  return result;
}

Motion reverse(Motion motion) {
  Clip& clip = motion.clip;
  const Rows rows = clip.mutate();
  for (std::size_t f = 0; f < clip.num_frames / 2; ++f) {
    const auto row = rows[f];
    std::swap_ranges(row.begin(), row.end(), rows[clip.num_frames - 1 - f].begin());
  }
  const Array<double> times = own_times(clip.timeline);
  if (FrameTimes* const own = std::get_if<FrameTimes>(&clip.timeline.given)) {
    const std::span<double> reversed = own->seconds.mutate();
    for (std::size_t f = 0; f < times.size(); ++f) {
      reversed[f] = times.front() + (times.back() - times[times.size() - 1 - f]);
    }
  }
  return motion;
}

}  // namespace kinefile::edit
