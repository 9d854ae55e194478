// SPDX-License-Identifier: MIT
// Finds the ticks of poses by dynamic programming over all possible ticks.
//
// A path goes from tick 0 to the last one in segments of 1 to kMaxTicks ticks. For every tick, in
// order, the search finds the fewest poses of a path within the tolerance that ends there. It tries
// the earlier ticks that were reached with the fewest poses, then those with one more, until a
// segment from one of them meets the tolerance. A failing segment does not imply that longer or
// shorter ones fail (words are rounded, trajectories bend), so all are tried. But nearly all
// failing segments fail at the same tick and joint as the previous one, so that place is checked
// first.

#include "servo/keyframe_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "kinefile/pose_flow.hpp"

namespace kinefile::servo {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// In ticks: the tolerance for rounding of times.
constexpr double kTickMargin = 1e-6;
constexpr std::size_t kLongest = kMaxTicks;
/// How many ticks are computed between checks whether a segment has failed.
constexpr std::size_t kTicksAtOnce = 8;

/// The place where a segment was too far from the trajectory.
struct Failure {
  std::size_t tick = 0;
  std::size_t joint = 0;
};

/// Computes errors of segments, up to a bound.
class SegmentErrors {
 public:
  explicit SegmentErrors(const WordTrack& track)
      : track_(track),
        from_(track.num_joints),
        ways_(track.num_joints),
        halves_(track.num_joints),
        largest_(track.num_joints),
        failures_(track.last_tick + 1) {}

  /// The error of a segment; if it is above the bound, a lower limit of the error that is above the
  /// bound.
  double operator()(std::size_t from, std::size_t to, double bound) {
    Failure& failure = failures_[from];
    if (failure.tick > from && failure.tick <= to) {
      const double error = error_at(from, to, failure);
      if (error > bound) return error;
    }
    begin(from, to);
    const std::size_t length = to - from;
    for (std::size_t k = 1; k <= length; k += kTicksAtOnce) {
      const std::size_t end = std::min(k + kTicksAtOnce, length + 1);
      for (std::size_t at = k; at < end; ++at) add_tick(from, at, length);
      const auto worst = std::max_element(largest_.begin(), largest_.end());
      if (!(*worst > bound)) continue;
      failure.joint = static_cast<std::size_t>(worst - largest_.begin());
      failure.tick = from + k;
      while (!(error_at(from, to, failure) > bound)) ++failure.tick;
      return *worst;
    }
    return *std::max_element(largest_.begin(), largest_.end());
  }

 private:
  void begin(std::size_t from, std::size_t to) {
    const std::int16_t* a = track_.words.data() + from * track_.num_joints;
    const std::int16_t* b = track_.words.data() + to * track_.num_joints;
    for (std::size_t j = 0; j < track_.num_joints; ++j) {
      from_[j] = a[j];
      ways_[j] = b[j] - a[j];
      halves_[j] = ways_[j] < 0 ? -0.5 : 0.5;
    }
    std::fill(largest_.begin(), largest_.end(), 0.0);
  }

  /// `played_word` for all joints, in a form that the compiler can vectorise: with the added half,
  /// the quotient is far enough from whole numbers that rounding does not change the result.
  void add_tick(std::size_t first, std::size_t k, std::size_t length) {
    const double* target = track_.targets.data() + (first + k) * track_.num_joints;
    const double* degrees = track_.degrees_each.data();
    const double* from = from_.data();
    const double* ways = ways_.data();
    const double* halves = halves_.data();
    double* largest = largest_.data();
    const auto steps = static_cast<double>(k);
    const double share = 1 / static_cast<double>(length);
    for (std::size_t j = 0; j < track_.num_joints; ++j) {
      const auto way = static_cast<std::int32_t>((ways[j] * steps + halves[j]) * share);
      const double error = std::abs(from[j] + static_cast<double>(way) - target[j]) * degrees[j];
      largest[j] = error > largest[j] ? error : largest[j];
    }
  }

  double error_at(std::size_t from, std::size_t to, const Failure& at) const {
    const std::size_t n = track_.num_joints;
    const auto word = played_word(
        track_.words[from * n + at.joint], track_.words[to * n + at.joint],
        static_cast<std::int32_t>(at.tick - from), static_cast<std::int32_t>(to - from));
    return std::abs(word - track_.targets[at.tick * n + at.joint]) * track_.degrees_each[at.joint];
  }

  const WordTrack& track_;
  std::vector<double> from_, ways_, halves_, largest_;  ///< by joint, for the current segment
  std::vector<Failure> failures_;                       ///< the last failure, by a segment's first
                                                        ///< tick
};

/// How a tick is reached.
struct Reached {
  std::uint32_t num_poses = 0;  ///< 0: not reached
  std::uint32_t before = 0;     ///< the tick of the previous pose
  double largest_error = 0;     ///< of the path to the tick
};

/// The requirements on a path.
struct Wanted {
  double tolerance = kInfinity;
  std::size_t most_poses = std::numeric_limits<std::uint32_t>::max();
  bool is_closest = false;  ///< of the paths with the fewest poses, find the one with the smallest
                            ///< error
};

/// One run of the search.
class Search {
 public:
  Search(const WordTrack& track, SegmentErrors& errors, const Wanted& wanted)
      : track_(track), errors_(errors), wanted_(wanted), reached_(track.last_tick + 1) {}

  std::optional<KeyTicks> run() {
    const double first_error = pose_error(track_, 0);
    note_failure(first_error);
    if (first_error > wanted_.tolerance) return std::nullopt;
    put(0, {1, 0, first_error});
    for (std::size_t tick = 1; tick <= track_.last_tick; ++tick) reach(tick);
    if (reached_.back().num_poses == 0) return std::nullopt;
    return path();
  }

  /// The search gives the same result with every tolerance below this one.
  double next_tolerance() const { return next_tolerance_; }

 private:
  /// The ticks that were reached with one number of poses, in order.
  struct Level {
    std::vector<std::uint32_t> ticks;
    std::size_t first = 0;  ///< the first tick that is not too early
  };

  void put(std::size_t tick, const Reached& reached) {
    reached_[tick] = reached;
    if (levels_.size() <= reached.num_poses) levels_.resize(reached.num_poses + 1);
    levels_[reached.num_poses].ticks.push_back(static_cast<std::uint32_t>(tick));
  }

  void note_failure(double error) {
    if (error > wanted_.tolerance) next_tolerance_ = std::min(next_tolerance_, error);
  }

  void reach(std::size_t tick) {
    const std::size_t earliest = tick > kLongest ? tick - kLongest : 0;
    while (lowest_level_ < levels_.size() && drop_before(levels_[lowest_level_], earliest)) {
      ++lowest_level_;
    }
    for (std::size_t n = lowest_level_; n < levels_.size() && n < wanted_.most_poses; ++n) {
      drop_before(levels_[n], earliest);
      const Reached best = from_level(levels_[n], tick);
      if (best.num_poses == 0) continue;
      put(tick, best);
      return;
    }
  }

  /// Skips ticks that are too early; returns whether none remains.
  static bool drop_before(Level& level, std::size_t earliest) {
    while (level.first < level.ticks.size() && level.ticks[level.first] < earliest) ++level.first;
    return level.first == level.ticks.size();
  }

  Reached from_level(const Level& level, std::size_t tick) {
    Reached best;
    double bound = wanted_.tolerance;
    for (std::size_t i = level.ticks.size(); i-- > level.first;) {
      const std::uint32_t from = level.ticks[i];
      const Reached& way = reached_[from];
      if (best.num_poses > 0 && way.largest_error >= bound) continue;
      const double error = errors_(from, tick, bound);
      note_failure(error);
      if (error > bound || (best.num_poses > 0 && error == bound)) continue;
      best = {way.num_poses + 1, from, std::max(way.largest_error, error)};
      if (!wanted_.is_closest) return best;
      bound = best.largest_error;
    }
    return best;
  }

  KeyTicks path() const {
    KeyTicks keys;
    keys.largest_error = reached_.back().largest_error;
    std::size_t tick = track_.last_tick;
    for (std::size_t n = reached_.back().num_poses; n > 0; --n) {
      keys.ticks.push_back(tick);
      tick = reached_[tick].before;
    }
    std::reverse(keys.ticks.begin(), keys.ticks.end());
    return keys;
  }

  const WordTrack& track_;
  SegmentErrors& errors_;
  Wanted wanted_;
  std::vector<Reached> reached_;  ///< by tick
  std::vector<Level> levels_;     ///< by number of poses
  std::size_t lowest_level_ = 0;  ///< the first level with ticks that are not too early
  double next_tolerance_ = kInfinity;
};

}  // namespace

Result<std::size_t> num_ticks_of(double seconds, double tick_seconds) {
  const double ticks = seconds / tick_seconds;
  if (!(ticks >= 0)) {
    return fail(make_error(ErrorKind::InvalidInput, "KEY004",
                           fmt::format("expected a duration, found {} s", seconds)));
  }
  if (ticks > static_cast<double>(kMostTicks)) {
    return fail(make_error(ErrorKind::Usage, "KEY001",
                           fmt::format("expected at most {} ticks of {} s, found a motion of {} s",
                                       kMostTicks, tick_seconds, seconds)));
  }
  return static_cast<std::size_t>(std::ceil(std::max(0.0, ticks - kTickMargin)));
}

double segment_error(const WordTrack& track, std::size_t from, std::size_t to) {
  return SegmentErrors(track)(from, to, kInfinity);
}

double pose_error(const WordTrack& track, std::size_t tick) {
  double largest = 0;
  for (std::size_t j = 0; j < track.num_joints; ++j) {
    const std::size_t at = tick * track.num_joints + j;
    largest =
        std::max(largest, std::abs(track.words[at] - track.targets[at]) * track.degrees_each[j]);
  }
  return largest;
}

std::size_t least_poses(const WordTrack& track) {
  return 1 + (track.last_tick + kLongest - 1) / kLongest;
}

std::optional<KeyTicks> fewest_poses(const WordTrack& track, double tolerance) {
  SegmentErrors errors(track);
  return Search(track, errors, {.tolerance = tolerance, .is_closest = true}).run();
}

KeyTicks closest_poses(const WordTrack& track, std::size_t num_poses) {
  SegmentErrors errors(track);
  // Below `low` there is no path, with `high` there is one. Both are errors of segments, or parts
  // of such, so that they meet.
  double low = std::max(pose_error(track, 0), pose_error(track, track.last_tick));
  double high = Search(track, errors, {.most_poses = num_poses}).run()->largest_error;
  while (low < high) {
    double middle = low + (high - low) / 2;
    if (!(middle < high)) middle = low;
    Search search(track, errors, {.tolerance = middle, .most_poses = num_poses});
    if (const auto keys = search.run()) {
      high = keys->largest_error;
    } else {
      low = search.next_tolerance();
    }
  }
  return *Search(track, errors, {.tolerance = high, .is_closest = true}).run();
}

}  // namespace kinefile::servo
