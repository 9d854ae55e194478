// SPDX-License-Identifier: MIT
#include "kinefile/anomalies.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "kinefile/kinematics.hpp"

namespace kinefile {
namespace {

constexpr double kSuddenFlip = 90;        // degrees from one frame to the next
constexpr double kSuddenSpike = 30;       // the same, of a turn that is undone
constexpr double kSuddenSpeed = 2700;     // degrees per second: 90 degrees at 30 frames a second
constexpr std::size_t kLongestSpike = 5;  // frames
/// The same, of a spike below kSuddenFlip: a punch is back after four frames at 120 a second.
constexpr std::size_t kLongestSmallSpike = 2;

/// The angle between a joint's rotations in two frames, in degrees; nothing if one is missing.
std::optional<double> turn_between(const LocalPoses& poses, std::size_t joint, std::size_t a,
                                   std::size_t b) {
  const auto rotation = [&poses, joint](std::size_t frame) {
    const double* q = &poses.rotations[(frame * poses.num_joints + joint) * 4];
    return Quat(q[0], q[1], q[2], q[3]);
  };
  const double angle = angle_between(rotation(a), rotation(b)) / kRadiansPerDegree;
  return std::isfinite(angle) ? std::optional(angle) : std::nullopt;
}

/// How far a joint turns from a frame to the next at the sudden speed, in degrees.
double turn_at_sudden_speed(const Timeline& timeline, std::size_t frame) {
  const double seconds = has_own_times(timeline)
                             ? time_of_frame(timeline, frame + 1) - time_of_frame(timeline, frame)
                             : frame_time(timeline);
  return kSuddenSpeed * seconds;
}

/// The frame of `poses` in which a joint has turned back after a turn between `before` and the next
/// frame.
std::optional<std::size_t> return_after(const LocalPoses& poses, std::size_t joint,
                                        std::size_t before, double degrees) {
  const std::size_t end = std::min(before + 2 + kLongestSpike, poses.num_frames);
  for (std::size_t f = before + 2; f < end; ++f) {
    const auto left = turn_between(poses, joint, before, f);
    if (left && *left < degrees / 2) return f;
  }
  return std::nullopt;
}

/// Finds the turns of a joint that begin before frame `end` of `poses`.
/// \param next  the frame of the motion from which turns count: turning back is not reported
void find_turns(const LocalPoses& poses, const Timeline& timeline, std::size_t joint,
                std::size_t end, std::size_t& next, std::vector<SuddenTurn>& turns) {
  for (std::size_t f = 0; f < end && f + 1 < poses.num_frames; ++f) {
    if (poses.first_frame + f < next) continue;
    const auto degrees = turn_between(poses, joint, f, f + 1);
    if (!degrees || !(*degrees > kSuddenSpike)) continue;
    if (!(*degrees > turn_at_sudden_speed(timeline, poses.first_frame + f))) continue;
    const auto back = return_after(poses, joint, f, *degrees);
    const bool is_small = !(*degrees > kSuddenFlip);
    if (is_small && (!back || *back > f + 1 + kLongestSmallSpike)) continue;
    SuddenTurn turn{joint, poses.first_frame + f + 1, 0, *degrees};
    if (back) {
      turn.return_frame = poses.first_frame + *back;
      next = turn.return_frame;
    }
    turns.push_back(turn);
  }
}

}  // namespace

std::vector<SuddenTurn> find_sudden_turns(const Motion& motion) {
  const std::size_t block = frames_per_block(motion.skeleton);
  std::vector<SuddenTurn> turns;
  std::vector<std::size_t> next(motion.skeleton.joints.size(), 0);
  KinematicsOptions options;
  options.rotations = true;
  options.num_frames = block + 1 + kLongestSpike;  // the search for turning back continues in the
                                                   // next block
  for (; options.first_frame < motion.clip.num_frames; options.first_frame += block) {
    const LocalPoses poses = local_poses(motion.skeleton, motion.clip, options);
    for (std::size_t j = 0; j < next.size(); ++j) {
      find_turns(poses, motion.clip.timeline, j, block, next[j], turns);
    }
  }
  std::stable_sort(turns.begin(), turns.end(),
                   [](const SuddenTurn& a, const SuddenTurn& b) { return a.joint < b.joint; });
  return turns;
}

}  // namespace kinefile
