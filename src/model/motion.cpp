// SPDX-License-Identifier: MIT
#include "kinefile/motion.hpp"

#include <fmt/format.h>

#include <cmath>

namespace kinefile {
namespace {

/// The first fault of a clip; empty if there is none.
std::string fault_of_clip(const Clip& clip, std::size_t num_columns) {
  if (clip.num_coordinates != num_columns) {
    return fmt::format("expected a column for each of {} coordinates, found {} columns",
                       num_columns, clip.num_coordinates);
  }
  if (clip.values.size() != clip.num_frames * clip.num_coordinates) {
    return fmt::format("expected {} frames of {} values, found {} values", clip.num_frames,
                       clip.num_coordinates, clip.values.size());
  }
  const std::size_t num_times = own_times(clip.timeline).size();
  if (num_times != 0 && num_times != clip.num_frames) {
    return fmt::format("expected a time for each of {} frames, found {}", clip.num_frames,
                       num_times);
  }
  if (!std::isfinite(duration(clip.timeline, clip.num_frames))) {
    return fmt::format("expected frames at finite times, found {} s from one to the next",
                       frame_time(clip.timeline));
  }
  return {};
}

}  // namespace

Result<void> validate(const Motion& motion) {
  if (auto valid = validate(motion.skeleton); !valid) return valid;
  const std::string fault = fault_of_clip(motion.clip, motion.skeleton.coordinates.size());
  if (!fault.empty()) return fail(ErrorKind::InvalidInput, "MDL002", fault);
  return {};
}

}  // namespace kinefile
