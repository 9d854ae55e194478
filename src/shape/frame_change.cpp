// SPDX-License-Identifier: MIT
#include "shape/frame_change.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace kinefile::shape {
namespace {

/// The frames of a changed motion as they are made.
struct Changing {
  FrameSource old_frames;
  FrameChange at_start;
  FrameChange now;
  std::size_t next_frame = 0;  ///< which `now` makes next
  Array<double> rows = {};     ///< the block that was made last
};

/// Makes the next frames.
Result<void> make(Changing& work, std::size_t count) {
  const auto old = work.old_frames.rows(work.next_frame, count);
  if (!old) return fail(old.error());
  const std::size_t width = work.now.skeleton.coordinates.size();
  work.rows.resize(count * width);
  work.now.fill(clip_of({work.next_frame, count, *old}, work.old_frames.num_coordinates),
                {work.rows.mutate(), width});
  work.next_frame += count;
  return {};
}

Result<std::span<const double>> rows_of(Changing& work, std::size_t first, std::size_t count) {
  if (first < work.next_frame) {
    work.now = work.at_start;
    work.next_frame = 0;
  }
  while (work.next_frame < first) {
    const std::size_t some = std::min(first - work.next_frame, frames_per_read(work.old_frames));
    if (auto made = make(work, some); !made) return fail(std::move(made.error()));
  }
  if (auto made = make(work, count); !made) return fail(std::move(made.error()));
  return std::span<const double>(work.rows);
}

}  // namespace

Clip clip_of(const FrameBlock& block, std::size_t num_coordinates) {
  return {block.num_frames, num_coordinates, Array<double>::adopt(block.rows, nullptr), {}};
}

Motion changed(const Motion& motion, FrameChange change) {
  if (!change.fill) return {std::move(change.skeleton), motion.clip};
  Motion result{std::move(change.skeleton), {}};
  result.clip.timeline = motion.clip.timeline;
  result.clip.num_frames = motion.clip.num_frames;
  result.clip.num_coordinates = result.skeleton.coordinates.size();
  result.clip.values.resize(result.clip.num_frames * result.clip.num_coordinates);
  change.fill(motion.clip, result.clip.mutate());
  return result;
}

LongMotion changed(const LongMotion& motion, FrameChange change) {
  LongMotion result = motion;
  Motion& head = std::get<Motion>(result.document.content);
  head.skeleton = change.skeleton;
  if (!change.fill) return result;
  head.clip.num_coordinates = head.skeleton.coordinates.size();
  result.frames.num_coordinates = head.clip.num_coordinates;
  const auto work = std::make_shared<Changing>(Changing{motion.frames, change, change});
  result.frames.rows = [work](std::size_t first, std::size_t count) {
    return rows_of(*work, first, count);
  };
  return result;
}

}  // namespace kinefile::shape
