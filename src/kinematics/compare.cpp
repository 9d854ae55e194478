// SPDX-License-Identifier: MIT
#include "kinefile/compare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinefile/kinematics.hpp"
#include "model/joint_names.hpp"

namespace kinefile {
namespace {

/// The joints to compare; also reports the joints that only one motion has.
std::vector<JointPair> pair_joints(const Skeleton& first, const Skeleton& second,
                                   MotionComparison& comparison) {
  std::vector<JointPair> pairs = match_joints(first, second);
  std::vector<bool> is_matched_first(first.joints.size(), false);
  std::vector<bool> is_matched_second(second.joints.size(), false);
  for (const JointPair pair : pairs) {
    is_matched_first[pair.first] = true;
    is_matched_second[pair.second] = true;
    if (first.joints[pair.first].tips.size() != second.joints[pair.second].tips.size()) {
      comparison.other_tips.push_back(first.joints[pair.first].name);
    }
  }
  for (std::size_t j = 0; j < first.joints.size(); ++j) {
    if (!is_matched_first[j]) comparison.only_in_first.push_back(first.joints[j].name);
  }
  for (std::size_t j = 0; j < second.joints.size(); ++j) {
    if (!is_matched_second[j]) comparison.only_in_second.push_back(second.joints[j].name);
  }
  return pairs;
}

/// Finds the frames of a clip that are nearest to times.
class NearestFrames {
 public:
  explicit NearestFrames(const Clip& clip) : clip_(clip) {
    const Array<double>& times = own_times(clip.timeline);
    times_.assign(times.begin(), times.begin() + std::min(times.size(), clip.num_frames));
    for (std::size_t f = 0; f < times_.size(); ++f) frames_.push_back(f);
    for (double& time : times_) time = std::isnan(time) ? 0 : time;  // NaN has no order
    if (std::is_sorted(times_.begin(), times_.end())) return;
    // A lenient reader may have accepted decreasing times.
    std::stable_sort(frames_.begin(), frames_.end(),
                     [this](std::size_t a, std::size_t b) { return times_[a] < times_[b]; });
    std::sort(times_.begin(), times_.end());
  }

  std::size_t at(double time) const {
    if (times_.empty()) {
      const double frame = std::round(frame_at_time(clip_.timeline, time));
      const auto last = static_cast<double>(clip_.num_frames - 1);
      return std::isnan(frame) ? 0 : static_cast<std::size_t>(std::clamp(frame, 0.0, last));
    }
    const FramePosition position = position_in_time(times_, time);
    const std::size_t next = std::min(position.frame + 1, times_.size() - 1);
    return frames_[position.share > 0.5 ? next : position.frame];
  }

 private:
  const Clip& clip_;
  std::vector<double> times_;        ///< rising
  std::vector<std::size_t> frames_;  ///< the frame of each of `times_`
};

/// The frames of the second clip that are nearest to those of the first.
std::vector<std::size_t> partners_of(const Clip& first, const Clip& second) {
  const NearestFrames nearest(second);
  const double rate = nominal_frame_rate(first.timeline);
  const bool has_times = has_own_times(first.timeline);
  const bool are_at_one_rate = !has_times && have_same_times(first.timeline, second.timeline);
  std::vector<std::size_t> partners;
  partners.reserve(first.num_frames);
  for (std::size_t f = 0; f < first.num_frames; ++f) {
    if (are_at_one_rate) {
      partners.push_back(std::min(f, second.num_frames - 1));
      continue;
    }
    // Times from a truncated frame time would drift.
    const double time =
        has_times ? time_of_frame(first.timeline, f) : static_cast<double>(f) / rate;
    partners.push_back(nearest.at(time));
  }
  return partners;
}

/// How many of the frames from `start` on are compared at once, so that neither side needs too many
/// frames.
std::size_t frames_at_once(const std::vector<std::size_t>& partners, std::size_t start,
                           std::size_t most_a, std::size_t most_b) {
  std::size_t lowest = partners[start], highest = partners[start], count = 1;
  for (; count < most_a && start + count < partners.size(); ++count) {
    const std::size_t partner = partners[start + count];
    if (std::max(highest, partner) - std::min(lowest, partner) >= most_b) break;
    lowest = std::min(lowest, partner);
    highest = std::max(highest, partner);
  }
  return count;
}

/// The distance of two points; NaN equals NaN and nothing else.
/// \param scale  converts the second point to the unit of the first
double distance_of(const double* a, const double* second, double scale) {
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double b_k = scale * second[k];
    if (std::isnan(a[k]) && std::isnan(b_k)) continue;
    if (a[k] == b_k) continue;
    if (std::isnan(a[k]) || std::isnan(b_k)) return std::numeric_limits<double>::infinity();
    square += (a[k] - b_k) * (a[k] - b_k);
  }
  return std::sqrt(square);
}

double rotation_of(const double* a, const double* b) {
  const auto has_nan = [](const double* q) { return std::isnan(q[0] + q[1] + q[2] + q[3]); };
  if (has_nan(a) || has_nan(b)) {
    return has_nan(a) && has_nan(b) ? 0 : std::numeric_limits<double>::infinity();
  }
  return angle_between(Quat(a[0], a[1], a[2], a[3]), Quat(b[0], b[1], b[2], b[3])) /
         kRadiansPerDegree;
}

void keep_larger(LargestDifference& largest, double value, const std::string& joint,
                 std::size_t frame, double time) {
  if (!largest.joint.empty() && value <= largest.value) return;
  largest = {value, joint, frame, time};
}

struct Side {
  const Motion& motion;
  double scale;  ///< from the second motion's unit of length to the first's
  std::vector<std::size_t> first_tip;
  WorldPoses poses;

  const double* position(std::size_t row, std::size_t joint) const {
    return &poses.positions[(row * poses.num_joints + joint) * 3];
  }
  const double* rotation(std::size_t row, std::size_t joint) const {
    return &poses.rotations[(row * poses.num_joints + joint) * 4];
  }
  const double* tip(std::size_t row, std::size_t joint, std::size_t tip) const {
    return &poses.tips[(row * poses.num_tips + first_tip[joint] + tip) * 3];
  }
};

void compare_joint(const Side& a, const Side& b, JointPair pair, std::size_t row_a,
                   std::size_t row_b, MotionComparison& comparison) {
  const std::size_t frame = a.poses.first_frame + row_a;
  const double time = time_of_frame(a.motion.clip.timeline, frame);
  const Joint& joint = a.motion.skeleton.joints[pair.first];
  const std::size_t num_tips_b = b.motion.skeleton.joints[pair.second].tips.size();
  keep_larger(comparison.distance,
              distance_of(a.position(row_a, pair.first), b.position(row_b, pair.second), b.scale),
              joint.name, frame, time);
  keep_larger(comparison.rotation,
              rotation_of(a.rotation(row_a, pair.first), b.rotation(row_b, pair.second)),
              joint.name, frame, time);
  if (joint.tips.size() != num_tips_b) return;
  for (std::size_t t = 0; t < joint.tips.size(); ++t) {
    keep_larger(comparison.tip_distance,
                distance_of(a.tip(row_a, pair.first, t), b.tip(row_b, pair.second, t), b.scale),
                tip_label(joint, t), frame, time);
  }
}

void place(Side& side, std::size_t first_frame, std::size_t num_frames) {
  KinematicsOptions options;
  options.first_frame = first_frame;
  options.num_frames = num_frames;
  options.rotations = true;
  options.tips = true;
  side.poses = forward_kinematics(side.motion.skeleton, side.motion.clip, options);
}

}  // namespace

MotionComparison compare_motions(const Motion& first, const Motion& second) {
  if (first.clip.num_frames == 0 && second.clip.num_frames == 0) {
    Motion first_rest{first.skeleton, rest_clip(first.skeleton)};
    Motion second_rest{second.skeleton, rest_clip(second.skeleton)};
    MotionComparison at_rest = compare_motions(first_rest, second_rest);
    at_rest.num_frames_first = at_rest.num_frames_second = 0;
    return at_rest;
  }
  MotionComparison comparison;
  comparison.num_frames_first = first.clip.num_frames;
  comparison.num_frames_second = second.clip.num_frames;
  const auto pairs = pair_joints(first.skeleton, second.skeleton, comparison);
  if (first.clip.num_frames == 0 || second.clip.num_frames == 0) return comparison;

  const double unit_a = first.skeleton.metres_per_unit;
  const double unit_b = second.skeleton.metres_per_unit;
  const double scale = unit_a > 0 && unit_b > 0 && unit_a != unit_b ? unit_b / unit_a : 1;
  Side a{first, 1, first_tips_of_joints(first.skeleton), {}};
  Side b{second, scale, first_tips_of_joints(second.skeleton), {}};
  const std::vector<std::size_t> partners = partners_of(first.clip, second.clip);
  const std::size_t most_a = frames_per_block(first.skeleton);
  const std::size_t most_b = frames_per_block(second.skeleton);
  for (std::size_t start = 0; start < first.clip.num_frames; start += a.poses.num_frames) {
    const std::size_t count = frames_at_once(partners, start, most_a, most_b);
    const auto begin = partners.begin() + static_cast<std::ptrdiff_t>(start);
    const auto [lowest, highest] =
        std::minmax_element(begin, begin + static_cast<std::ptrdiff_t>(count));
    place(a, start, count);
    place(b, *lowest, *highest - *lowest + 1);
    for (std::size_t row = 0; row < count; ++row) {
      const std::size_t row_b = partners[start + row] - *lowest;
      for (const JointPair pair : pairs) compare_joint(a, b, pair, row, row_b, comparison);
    }
  }
  return comparison;
}

}  // namespace kinefile
