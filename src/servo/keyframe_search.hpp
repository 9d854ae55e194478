// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "kinefile/result.hpp"

namespace kinefile::servo {

/// One hour at 60 ticks per second, the default limit of `flow::run`.
inline constexpr std::size_t kMostTicks = 216'000;

/// The number of ticks of a time, rounded up.
/// \errors KEY001 (Usage) if there are more than `kMostTicks`; KEY004 for a negative time or NaN
Result<std::size_t> num_ticks_of(double seconds, double tick_seconds);

/// A trajectory at ticks, in words.
struct WordTrack {
  std::size_t num_joints = 0;
  std::size_t last_tick = 0;
  std::vector<double> targets;       ///< [tick][joint], neither rounded nor limited
  std::vector<std::int16_t> words;   ///< [tick][joint], what a pose at that tick has
  std::vector<double> degrees_each;  ///< by joint: degrees degrees per unit of a word
};

/// Ticks of poses, the first 0 and the last `last_tick`, 1 to `kMaxTicks` apart.
struct KeyTicks {
  std::vector<std::size_t> ticks;
  double largest_error = 0;  ///< degrees
};

/// The word at a tick between two poses, as in `flow::run`: from + trunc((to - from) k / n).
constexpr std::int32_t played_word(std::int32_t from, std::int32_t to, std::int32_t k,
                                   std::int32_t n) {
  return from + (to - from) * k / n;
}

/// The largest difference in degrees between the playback from one tick's words to another's and
/// the trajectory, at all ticks after the first.
double segment_error(const WordTrack& track, std::size_t from, std::size_t to);

/// The same for a single pose, at its tick.
double pose_error(const WordTrack& track, std::size_t tick);

/// The fewest poses whose playback stays within a tolerance, and of these the ones with the
/// smallest maximum error; nothing if there are none.
std::optional<KeyTicks> fewest_poses(const WordTrack& track, double tolerance);

/// At most `num_poses` poses with the smallest maximum error, and of these the fewest.
/// Precondition: `num_poses` is at least `least_poses`.
KeyTicks closest_poses(const WordTrack& track, std::size_t num_poses);

/// The minimum number of poses, because a pose takes at most `kMaxTicks`.
std::size_t least_poses(const WordTrack& track);

}  // namespace kinefile::servo
