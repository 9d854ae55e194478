// SPDX-License-Identifier: MIT
#include "kinefile/timeline.hpp"

namespace kinefile {

double frame_time(const Timeline& timeline) {
  return timeline.given == Timeline::Given::FrameTime ? timeline.value : 1 / timeline.value;
}

double frame_rate(const Timeline& timeline) {
  return timeline.given == Timeline::Given::FrameRate ? timeline.value : 1 / timeline.value;
}

double time_of_frame(const Timeline& timeline, std::size_t frame) {
  if (frame < timeline.times.size()) return timeline.times[frame];
  const auto number = static_cast<double>(frame);
  // Dividing by a rate is exact where multiplying by its rounded inverse is not.
  const bool has_rate = timeline.given == Timeline::Given::FrameRate;
  return has_rate ? number / timeline.value : number * timeline.value;
}

double duration(const Timeline& timeline, std::size_t num_frames) {
  if (num_frames == 0) return 0;
  return time_of_frame(timeline, num_frames - 1) - time_of_frame(timeline, 0);
}

}  // namespace kinefile
