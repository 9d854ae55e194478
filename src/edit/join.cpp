// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "edit/blend.hpp"
#include "edit/unwrap.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/evidence.hpp"
#include "kinefile/kinematics.hpp"
#include "kinematics/joint_columns.hpp"

namespace kinefile::edit {
namespace {

constexpr double kSameOffset = 1e-4;   // of the skeleton's size: exporters round
constexpr double kExactOffset = 1e-6;  // a larger difference is told

Error cannot_join(std::string why) {
  return make_error(ErrorKind::Usage, "EDT005", std::move(why));
}

/// How the degrees of freedom of a joint differ, or an empty text.
std::string difference_of_dofs(const Joint& a, const Joint& b) {
  const auto is_same = [](const DegreeOfFreedom& x, const DegreeOfFreedom& y) {
    return x.kind == y.kind && x.coordinate == y.coordinate && x.gain == y.gain &&
           x.shift == y.shift &&
           (num_coordinates(x) > 1 || (x.axis - y.axis).norm() <= kSameDirection);
  };
  const bool is_equal =
      std::equal(a.dofs.begin(), a.dofs.end(), b.dofs.begin(), b.dofs.end(), is_same);
  return is_equal ? "" : fmt::format("joint '{}' moves in other ways", a.name);
}

/// How two joints differ, or an empty text.
std::string difference_of(const Joint& a, const Joint& b, double tolerance) {
  if (a.name != b.name) return fmt::format("joint '{}' is called '{}' there", a.name, b.name);
  if (a.parent != b.parent) return fmt::format("joint '{}' hangs on another joint", a.name);
  if (!((a.offset - b.offset).norm() <= tolerance)) {
    return fmt::format("joint '{}' has another offset", a.name);
  }
  if (!(angle_between(a.rest_rotation, b.rest_rotation) <= kSameDirection)) {
    return fmt::format("joint '{}' rests turned in another way", a.name);
  }
  const auto is_same = [tolerance](const Tip& x, const Tip& y) {
    return (x.offset - y.offset).norm() <= tolerance;
  };
  if (!std::equal(a.tips.begin(), a.tips.end(), b.tips.begin(), b.tips.end(), is_same)) {
    return fmt::format("joint '{}' has other tips", a.name);
  }
  return difference_of_dofs(a, b);
}

/// The difference that prevents joining motions of two skeletons, or an empty text.
std::string difference_of(const Skeleton& a, const Skeleton& b) {
  if (a.angle_unit != b.angle_unit) return "one is in degrees and one in radians";
  const double tolerance = kSameOffset * rest_size(a);
  for (std::size_t j = 0; j < std::min(a.joints.size(), b.joints.size()); ++j) {
    std::string difference = difference_of(a.joints[j], b.joints[j], tolerance);
    if (!difference.empty()) return difference;
  }
  if (a.joints.size() != b.joints.size()) {
    return fmt::format("one has {} joints and one {}", a.joints.size(), b.joints.size());
  }
  const auto is_same = [](const Coordinate& x, const Coordinate& y) {
    return x.joint == y.joint && x.channel == y.channel;
  };
  const bool has_same_columns = std::equal(a.coordinates.begin(), a.coordinates.end(),
                                           b.coordinates.begin(), b.coordinates.end(), is_same);
  return has_same_columns ? "" : "their columns differ";
}

std::optional<Error> obstacle_to(const Motion& first, const Motion& second,
                                 std::size_t num_blend_frames) {
  const std::string difference = difference_of(first.skeleton, second.skeleton);
  if (!difference.empty()) {
    return cannot_join(fmt::format("the skeletons differ: {}", difference));
  }
  // Frames with their own times keep these.
  const bool is_steady =
      !has_own_times(first.clip.timeline) && !has_own_times(second.clip.timeline);
  if (is_steady && !have_same_rate(first.clip.timeline, second.clip.timeline)) {
    return cannot_join(fmt::format("the frame rates differ: {} and {} frames a second",
                                   nominal_frame_rate(first.clip.timeline),
                                   nominal_frame_rate(second.clip.timeline)));
  }
  const std::size_t fewest = std::min(first.clip.num_frames, second.clip.num_frames);
  if (num_blend_frames > fewest) {
    return cannot_join(
        fmt::format("{} frames cannot be blended where a motion has {}", num_blend_frames, fewest));
  }
  return std::nullopt;
}

/// Whether a clip of this many frames stays below the limit of 2^30 values.
bool is_too_large(double num_frames, std::size_t num_columns) {
  constexpr double kMostValues = 1073741824.0;
  return num_frames * static_cast<double>(std::max<std::size_t>(num_columns, 1)) > kMostValues;
}

/// The step from the last frame of a clip to the first of the next one: the median step of its own
/// times, or of the other's if it has too few.
double step_between(const Clip& first, const Clip& second) {
  if (!has_own_times(first.timeline)) return frame_time(first.timeline);
  const double own = median_step(own_times(first.timeline));
  if (own > 0) return own;
  const Array<double>& times = own_times(second.timeline);
  return has_own_times(second.timeline) ? median_step(times) : frame_time(second.timeline);
}

/// Continues the times of frames, if one of the clips has its own.
void append_times(Clip& first, const Clip& second, std::size_t num_blend_frames) {
  if (!has_own_times(first.timeline) && !has_own_times(second.timeline)) return;
  const std::size_t count = first.num_frames;
  std::vector<double> times;
  for (std::size_t f = 0; f < count; ++f) times.push_back(time_of_frame(first.timeline, f));
  double start = 0;  // the time of the second clip's first frame
  if (num_blend_frames > 0) start = times[count - num_blend_frames];
  if (num_blend_frames == 0 && count > 0) start = times.back() + step_between(first, second);
  const double shift = start - time_of_frame(second.timeline, 0);
  for (std::size_t f = num_blend_frames; f < second.num_frames; ++f) {
    times.push_back(time_of_frame(second.timeline, f) + (count > 0 ? shift : 0));
  }
  const FrameTimes* own = std::get_if<FrameTimes>(
      has_own_times(first.timeline) ? &first.timeline.given : &second.timeline.given);
  first.timeline.given = FrameTimes{times, own->per_second};
}

void append_rows(Clip& first, const Clip& second, std::size_t begin) {
  first.values.append(
      std::span<const double>(second.values).subspan(begin * second.num_coordinates));
  first.num_frames += second.num_frames - begin;
}

/// Tells how far the offsets of the second skeleton are from those of the first, which are used.
void tell_rounded_offsets(const Skeleton& first, const Skeleton& second, Diagnostics& diagnostics) {
  double largest = 0;
  for (std::size_t j = 0; j < first.joints.size(); ++j) {
    largest = std::max(largest, (first.joints[j].offset - second.joints[j].offset).norm());
  }
  if (!(largest > kExactOffset * rest_size(first))) return;
  diagnostics.add(
      Severity::Note, "EDT014",
      fmt::format("the offsets of the motion that follows differ by up to {:.2g}; those "
                  "of the first are used",
                  largest));
}

/// The ground of two motions that are joined. If different joints carry them, the roots do.
Ground ground_of(const Motion& first, const Motion& second, Diagnostics& diagnostics) {
  Ground ground{settle_up_axis(first, diagnostics).axis, find_travellers(first)};
  if (ground.travellers == find_travellers(second)) return ground;
  ground.travellers.clear();
  for (std::size_t j = 0; j < first.skeleton.joints.size(); ++j) {
    if (first.skeleton.joints[j].parent == kNoParent) ground.travellers.push_back(j);
  }
  return ground;
}

/// Appends a compatible motion (see `obstacle_to`).
/// \param ground  absent: the second motion is blended where it is
void append_to(Motion& first, const Motion& second, std::size_t num_blend_frames,
               const std::optional<Ground>& ground) {
  append_times(first.clip, second.clip, num_blend_frames);
  if (num_blend_frames == 0) {
    append_rows(first.clip, second.clip, 0);
    return;
  }
  const std::size_t overlap = first.clip.num_frames - num_blend_frames;
  const std::size_t half = num_blend_frames / 2;
  const Motion moved = ground ? moved_to(second, half, first, overlap + half, *ground) : second;
  std::vector<double> weights;
  for (std::size_t i = 0; i < num_blend_frames; ++i) {
    const double u = static_cast<double>(i + 1) / static_cast<double>(num_blend_frames + 1);
    weights.push_back(u * u * (3 - 2 * u));
  }
  fade(first.skeleton, moved.clip, weights, overlap, first.clip);
  append_rows(first.clip, moved.clip, num_blend_frames);
  // Both may hold the same rotation with angles that differ by whole turns.
  unwrap_from(first, overlap);
}

}  // namespace

Result<Motion> append(Motion first, const Motion& second, std::size_t num_blend_frames,
                      Diagnostics& diagnostics, bool is_moved) {
  if (auto error = obstacle_to(first, second, num_blend_frames)) return fail(std::move(*error));
  const double num_frames =
      static_cast<double>(first.clip.num_frames) + static_cast<double>(second.clip.num_frames);
  if (is_too_large(num_frames, first.clip.num_coordinates)) {
    return fail(cannot_join("the motion would have more than 2^30 values"));
  }
  tell_rounded_offsets(first.skeleton, second.skeleton, diagnostics);
  std::optional<Ground> ground;
  if (num_blend_frames > 0 && is_moved) {
    ground = ground_of(first, second, diagnostics);
    first.skeleton.up = ground->up;
  }
  append_to(first, second, num_blend_frames, ground);
  return first;
}

Result<Motion> loop(const Motion& motion, std::size_t count, std::size_t num_blend_frames,
                    Diagnostics& diagnostics, bool is_moved) {
  const Clip& clip = motion.clip;
  if (count == 0) return fail(cannot_join("a motion cannot be played 0 times"));
  if (num_blend_frames > clip.num_frames) {
    return fail(cannot_join(fmt::format("{} frames cannot be blended where a motion has {}",
                                        num_blend_frames, clip.num_frames)));
  }
  if (is_too_large(static_cast<double>(clip.num_frames) * static_cast<double>(count),
                   clip.num_coordinates)) {
    return fail(cannot_join("the motion would have more than 2^30 values"));
  }
  Motion result = motion;
  if (clip.num_frames == 0) return result;
  result.clip.values.reserve(clip.values.size() * count);
  std::optional<Ground> ground;
  if (num_blend_frames > 0 && is_moved) {
    ground = ground_of(motion, motion, diagnostics);
    result.skeleton.up = ground->up;
  }
  for (std::size_t i = 1; i < count; ++i) append_to(result, motion, num_blend_frames, ground);
  return result;
}

}  // namespace kinefile::edit
