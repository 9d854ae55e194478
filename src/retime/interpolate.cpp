// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <functional>

#include "base/parallel.hpp"
#include "retime/interpolate_gaps.hpp"
#include "retime/interpolate_numbers.hpp"
#include "retime/interpolate_plan.hpp"
#include "retime/interpolate_rotations.hpp"
#include "retime/interpolate_steps.hpp"

namespace kinefile::retime {
namespace {

constexpr std::size_t kMostValues = std::size_t{1} << 30;  // 8 GiB

/// The old timeline for another number of frames: the frames' own times are no longer valid.
Timeline without_times(Timeline timeline) {
  if (has_own_times(timeline)) timeline.given = FrameRate{frame_rate(timeline)};
  return timeline;
}

Clip empty_clip(const Clip& old_clip, const TimeMap& map) {
  Clip clip;
  clip.num_frames = old_clip.num_frames > 0 ? map.old_frames.size() : 0;
  clip.num_coordinates = old_clip.num_coordinates;
  clip.values.resize(clip.num_frames * clip.num_coordinates);
  clip.timeline = map.timeline ? *map.timeline : without_times(old_clip.timeline);
  return clip;
}

/// Calls `work` with parts of the steps, on several threads if there are many of them.
void for_each_part(const std::vector<Step>& steps, std::size_t num_coordinates,
                   const std::function<void(const std::vector<Step>&)>& work) {
  constexpr std::size_t kNumbers = std::size_t{1} << 15;  // whose rows stay in a core's cache
  const std::size_t part =
      std::max<std::size_t>(kNumbers / std::max<std::size_t>(num_coordinates, 1), 1);
  if (!kHasThreads || steps.size() <= part) return work(steps);
  for_each_index((steps.size() + part - 1) / part, [&](std::size_t i) {
    const auto begin = steps.begin() + static_cast<std::ptrdiff_t>(i * part);
    const std::size_t count = std::min(part, steps.size() - i * part);
    work(std::vector<Step>(begin, begin + static_cast<std::ptrdiff_t>(count)));
  });
}

/// Makes the new frames of some steps.
void make_frames(const Clip& old_clip, const std::vector<Step>& steps,
                 const InterpolationPlan& plan, const std::vector<NumberColumn>& numbers,
                 const RetimeOptions& options, Clip& new_clip) {
  interpolate_rows(old_clip, steps, new_clip);
  turn_columns(old_clip, steps, numbers, new_clip);
  if (options.rotation == RotationInterpolation::Cubic) {
    curve_columns(old_clip, steps, numbers, new_clip);
  }
  if (options.antialias) average_columns(old_clip, steps, numbers, new_clip);
  interpolate_rotations(old_clip, steps, plan, options.rotation, new_clip);
}

}  // namespace

Result<Motion> apply(const Motion& motion, const TimeMap& map, const RetimeOptions& options,
                     Diagnostics& diagnostics) {
  const Clip& old_clip = motion.clip;
  assert(old_clip.num_coordinates == motion.skeleton.coordinates.size());
  assert(old_clip.num_frames > 0 || map.old_frames.empty());
  if (map.old_frames.size() > kMostValues / std::max<std::size_t>(old_clip.num_coordinates, 1)) {
    return fail(make_error(ErrorKind::Usage, "RTM008",
                           fmt::format("expected a motion of 2^30 values at the most, found {} "
                                       "frames of {}",
                                       map.old_frames.size(), old_clip.num_coordinates)));
  }
  Motion result{motion.skeleton, empty_clip(old_clip, map)};
  if (result.clip.num_frames == 0) return result;
  const auto steps = steps_of(map.old_frames, old_clip.num_frames, options.antialias);
  const auto plan = plan_interpolation(motion.skeleton, options.rotation, diagnostics);
  const auto numbers = number_columns_of(old_clip, plan);
  result.clip.mutate();  // not shared from here on, so that threads find it so
  for_each_part(steps, old_clip.num_coordinates, [&](const std::vector<Step>& some) {
    make_frames(old_clip, some, plan, numbers, options, result.clip);
  });
  const auto marked = mark_gaps(motion, steps, plan, options, result.clip, diagnostics);
  if (!marked) return fail(marked.error());
  return result;
}

}  // namespace kinefile::retime
