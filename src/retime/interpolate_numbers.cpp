// SPDX-License-Identifier: MIT
#include "retime/interpolate_numbers.hpp"

#include <algorithm>

namespace kinefile::retime {

void interpolate_rows(const Clip& old_clip, const std::vector<Step>& steps, Clip& new_clip) {
  for (const Step& step : steps) {
    const Around frames = around(step, old_clip.num_frames);
    const auto from = old_clip.row(frames.from);
    const auto to = old_clip.row(frames.to);
    const auto row = new_clip.mutate()[step.new_frame];
    if (step.t == 0) {
      std::copy(from.begin(), from.end(), row.begin());
      continue;
    }
    // Equal numbers give themselves, and the result is monotone in t.
    for (std::size_t c = 0; c < row.size(); ++c) row[c] = from[c] + step.t * (to[c] - from[c]);
  }
}

void curve_columns(const Clip& old_clip, const std::vector<Step>& steps,
                   const std::vector<std::size_t>& columns, Clip& new_clip) {
  for (const Step& step : steps) {
    if (step.t == 0) continue;
    const Around frames = around(step, old_clip.num_frames);
    const auto before = old_clip.row(frames.before);
    const auto from = old_clip.row(frames.from);
    const auto to = old_clip.row(frames.to);
    const auto after = old_clip.row(frames.after);
    const bool is_first = frames.before == frames.from;
    const bool is_last = frames.after == frames.to;
    const auto row = new_clip.mutate()[step.new_frame];
    for (const std::size_t c : columns) {
      // The rate at a frame is half the difference between the next and the previous frame.
      const double way = to[c] - from[c];
      const double rate_from = is_first ? way : 0.5 * (to[c] - before[c]);
      const double rate_to = is_last ? way : 0.5 * (after[c] - from[c]);
      const double square = 3 * way - 2 * rate_from - rate_to;
      const double cube = rate_from + rate_to - 2 * way;
      row[c] = from[c] + step.t * (rate_from + step.t * (square + step.t * cube));
    }
  }
}

void average_columns(const Clip& old_clip, const std::vector<Step>& steps,
                     const std::vector<std::size_t>& columns, Clip& new_clip) {
  for (const Step& step : steps) {
    if (!step.is_average()) continue;
    const auto from = old_clip.row(step.old_frame);
    const auto row = new_clip.mutate()[step.new_frame];
    for (const std::size_t c : columns) row[c] = from[c];
    // Differences are averaged, so that constant values keep every bit.
    for (const Tap& tap : taps_of(step, old_clip.num_frames)) {
      const auto old_row = old_clip.row(tap.old_frame);
      for (const std::size_t c : columns) row[c] += tap.weight * (old_row[c] - from[c]);
    }
  }
}

}  // namespace kinefile::retime
