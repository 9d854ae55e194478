// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "kinefile/evidence.hpp"
#include "kinefile/kinematics.hpp"
#include "kinefile/retime.hpp"
#include "model/joint_names.hpp"
#include "retime/curves.hpp"
#include "retime/dtw.hpp"
#include "retime/frame_distance.hpp"
#include "retime/frames.hpp"

namespace kinefile::retime {
namespace {

/// The joints that two skeletons share; equal indices belong together.
struct SharedJoints {
  std::vector<std::size_t> first;
  std::vector<std::size_t> second;
};

SharedJoints joints_in_both(const Skeleton& first, const Skeleton& second) {
  SharedJoints shared;
  for (const JointPair pair : match_joints(first, second)) {
    shared.first.push_back(pair.first);
    shared.second.push_back(pair.second);
  }
  return shared;
}

/// The number of compared frames is limited so that time and memory stay bounded: about a second.
std::size_t most_samples(const Skeleton& first, const Skeleton& second) {
  constexpr double kMostSamples = 1500;
  constexpr double kMostComparisons = 1.2e8;  // of pairs of joints
  const std::size_t joints = std::max(first.joints.size(), second.joints.size());
  const double affordable = std::sqrt(kMostComparisons / static_cast<double>(joints));
  return static_cast<std::size_t>(std::clamp(affordable, 2.0, kMostSamples));
}

/// Evenly spaced frames of a motion, including the first and the last.
std::vector<std::size_t> sampled_frames(std::size_t num_frames, std::size_t most) {
  const std::size_t count = std::min(num_frames, most);
  std::vector<std::size_t> frames = {0};
  for (std::size_t k = 1; k < count; ++k) {
    const double frame = static_cast<double>(k) * static_cast<double>(num_frames - 1) /
                         static_cast<double>(count - 1);
    frames.push_back(static_cast<std::size_t>(std::round(frame)));
  }
  return frames;
}

Motion with_frames(const Motion& motion, const std::vector<std::size_t>& frames) {
  Motion result{motion.skeleton, {}};
  result.clip.num_frames = frames.size();
  result.clip.num_coordinates = motion.clip.num_coordinates;
  for (const std::size_t frame : frames) {
    const auto row = motion.clip.row(frame);
    result.clip.values.append(row);
  }
  return result;
}

/// The factor from a motion's lengths to those of another: by metres if both specify their units,
/// otherwise by the sizes of the rest poses.
double length_scale(const Motion& motion, const Motion& other) {
  const bool has_units = motion.skeleton.metres_per_unit > 0 && other.skeleton.metres_per_unit > 0;
  if (has_units) return motion.skeleton.metres_per_unit;
  const double size = rest_size(motion.skeleton);
  return size > 0 && std::isfinite(size) ? 1 / size : 1;
}

/// The pairs of the two motions' frames that belong together.
std::vector<FramePair> align_frames(const Motion& reference, const Motion& motion,
                                    const SharedJoints& shared, AlignOptions::By by,
                                    Diagnostics& diagnostics) {
  const auto align = [&](const auto& rows, const auto& columns) {
    return align_sequences(
        reference.clip.num_frames, motion.clip.num_frames,
        [&](std::size_t row, std::size_t column) { return distance(rows, row, columns, column); });
  };
  if (by == AlignOptions::By::Angles) {
    return align(angles_of_frames(reference, shared.first),
                 angles_of_frames(motion, shared.second));
  }
  const auto points = [&](const Motion& one, const Motion& other,
                          const std::vector<std::size_t>& joints) {
    return points_of_frames(one, joints, length_scale(one, other),
                            settle_up_axis(one, diagnostics).axis);
  };
  return align(points(reference, motion, shared.first), points(motion, reference, shared.second));
}

double number(std::size_t count) { return static_cast<double>(count); }

/// The deviation of the motion's frame from the linear map, at each sampled frame of the reference;
/// the mean if several of the motion's frames belong to one.
std::vector<double> departures(const std::vector<FramePair>& way,
                               const std::vector<std::size_t>& reference_frames,
                               const std::vector<std::size_t>& motion_frames) {
  const Knot start{0, 0};
  const Knot end{number(reference_frames.back()), number(motion_frames.back())};
  std::vector<double> sums(reference_frames.size(), 0.0);
  std::vector<double> counts(reference_frames.size(), 0.0);
  for (const FramePair pair : way) {
    sums[pair.row] += number(motion_frames[pair.column]) -
                      straight_at(start, end, number(reference_frames[pair.row]));
    ++counts[pair.row];
  }
  for (std::size_t r = 0; r < sums.size(); ++r) sums[r] /= counts[r];
  return sums;
}

/// The mean over a symmetric neighbourhood of an index.
double smoothed(const std::vector<double>& values, std::size_t at, std::size_t reach) {
  reach = std::min({reach, at, values.size() - 1 - at});
  double sum = 0;
  for (std::size_t i = at - reach; i <= at + reach; ++i) sum += values[i];
  return sum / number(2 * reach + 1);
}

/// Knots every few samples of a strictly increasing map, from the first frames to the last.
std::vector<Knot> rising_knots(const std::vector<double>& departures,
                               const std::vector<std::size_t>& reference_frames,
                               double last_motion_frame) {
  constexpr std::size_t kSpacing = 8;  // in samples: twice the length of the longest run
  const std::size_t last = departures.size() - 1;
  const std::size_t num_pieces = std::max<std::size_t>(last / kSpacing, 1);
  const Knot start{0, 0};
  const Knot end{number(reference_frames.back()), last_motion_frame};
  std::vector<Knot> knots;
  for (std::size_t k = 0; k <= num_pieces; ++k) {
    const std::size_t at = k * last / num_pieces;
    const double x = number(reference_frames[at]);
    const double straight = straight_at(start, end, x);
    double y = straight + smoothed(departures, at, kSpacing / 2);
    y = std::clamp(y, knots.empty() ? 0 : knots.back().y, last_motion_frame);
    knots.push_back({x, y});
  }
  knots.front() = start;
  knots.back() = end;
  // A small share of the linear map keeps the curve increasing where the motions stand still.
  constexpr double kShare = 1e-6;
  for (Knot& knot : knots) {
    knot.y += kShare * (straight_at(start, end, knot.x) - knot.y);
  }
  return knots;
}

/// The smooth curve through knots at every frame of the reference.
std::vector<double> frames_through(const std::vector<Knot>& knots, std::size_t num_frames) {
  const std::vector<double> slopes = pchip_slopes(knots);
  std::vector<double> old_frames;
  old_frames.reserve(num_frames);
  std::size_t k = 0;
  for (std::size_t frame = 0; frame + 1 < num_frames; ++frame) {
    const double x = number(frame);
    while (x >= knots[k + 1].x) ++k;
    const double y = cubic_at(knots[k], slopes[k], knots[k + 1], slopes[k + 1], x);
    old_frames.push_back(on_whole_frame(std::clamp(y, knots[k].y, knots[k + 1].y)));
  }
  old_frames.push_back(knots.back().y);
  return old_frames;
}

tl::unexpected<Error> refuse_alignment(std::string message) {
  return fail(make_error(ErrorKind::Usage, "RTM004", std::move(message)));
}

}  // namespace

Result<TimeMap> align_map(const Motion& motion, const Motion& reference,
                          const AlignOptions& options, Diagnostics& diagnostics) {
  const SharedJoints shared = joints_in_both(reference.skeleton, motion.skeleton);
  if (shared.first.empty()) {
    return refuse_alignment("expected joints of the same names in both motions, found none");
  }
  if (motion.clip.num_frames == 0 || reference.clip.num_frames == 0) {
    return refuse_alignment("expected motions with frames, found one without");
  }
  TimeMap map;
  map.timeline = reference.clip.timeline;
  if (motion.clip.num_frames == 1 || reference.clip.num_frames == 1) {
    map.old_frames.assign(reference.clip.num_frames, 0.0);
    return map;
  }
  const std::size_t most = most_samples(reference.skeleton, motion.skeleton);
  const auto reference_frames = sampled_frames(reference.clip.num_frames, most);
  const auto motion_frames = sampled_frames(motion.clip.num_frames, most);
  const auto way =
      align_frames(with_frames(reference, reference_frames), with_frames(motion, motion_frames),
                   shared, options.by, diagnostics);
  const auto knots = rising_knots(departures(way, reference_frames, motion_frames),
                                  reference_frames, number(motion_frames.back()));
  map.old_frames = frames_through(knots, reference.clip.num_frames);
  return map;
}

}  // namespace kinefile::retime
