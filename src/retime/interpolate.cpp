// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cassert>

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
  interpolate_rows(old_clip, steps, result.clip);
  const auto numbers = number_columns_of(old_clip, plan);
  turn_columns(old_clip, steps, numbers, result.clip);
  if (options.rotation == RotationInterpolation::Cubic) {
    curve_columns(old_clip, steps, numbers, result.clip);
  }
  if (options.antialias) average_columns(old_clip, steps, numbers, result.clip);
  interpolate_rotations(old_clip, steps, plan, options.rotation, result.clip);
  const auto marked = mark_gaps(motion, steps, plan, options, result.clip, diagnostics);
  if (!marked) return fail(marked.error());
  return result;
}

}  // namespace kinefile::retime
