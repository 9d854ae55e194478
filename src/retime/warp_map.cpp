// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinefile/retime.hpp"
#include "retime/curves.hpp"
#include "retime/ease.hpp"
#include "retime/frames.hpp"
#include "retime/stretch.hpp"

namespace kinefile::retime {
namespace {

/// The line after the last knot.
struct StraightTail {
  double rise = 1;  ///< old frames
  double run = 1;   ///< new frames for `rise`
  double end = 0;   ///< the new frame at which it reaches the end of the motion
  double end_old = 0;
};

/// A map before its frames are computed.
struct Plan {
  std::vector<Knot> knots;
  std::vector<double> slopes = {};  ///< at the knots; empty: straight pieces, eased
  Ease ease = {};
  bool is_curve_monotone = true;  ///< between any two knots
  StraightTail tail = {};
};

tl::unexpected<Error> refuse_keys(std::string message) {
  return fail(make_error(ErrorKind::Usage, "RTM001", std::move(message)));
}

std::string text_of(const Knot& key) { return fmt::format("{}:{}", key.y, key.x); }

Result<void> check_key(const Knot& key, double last_frame) {
  if (!(key.y >= 0 && key.y <= last_frame)) {
    return refuse_keys(fmt::format("expected an old frame from 0 to {}, found the key {}",
                                   last_frame, text_of(key)));
  }
  if (!(key.x >= 0 && key.x < kMostFrames)) {
    return refuse_keys(fmt::format("expected a new frame from 0 to {}, found the key {}",
                                   kMostFrames - 1, text_of(key)));
  }
  return {};
}

/// The keys sorted by new frames, including the implied 0:0.
Result<std::vector<Knot>> sorted_keys(const WarpOptions& options, double last_frame) {
  std::vector<Knot> keys;
  for (const WarpKey& key : options.keys) {
    keys.push_back({key.new_frame + 0.0, key.old_frame + 0.0});  // -0 becomes 0
    auto checked = check_key(keys.back(), last_frame);
    if (!checked) return fail(std::move(checked.error()));
  }
  const auto is_first = [](const Knot& key) { return key.x == 0; };
  if (std::none_of(keys.begin(), keys.end(), is_first)) keys.insert(keys.begin(), Knot{0, 0});
  std::stable_sort(keys.begin(), keys.end(),
                   [](const Knot& a, const Knot& b) { return a.x < b.x; });
  return keys;
}

/// Adds the last frame as a key, which keeps the length.
Result<void> keep_length(std::vector<Knot>& keys, double last_frame) {
  const Knot last = keys.back();
  if (last.x == last_frame && last.y == last_frame) return {};
  if (last.x >= last_frame) {
    return refuse_keys(fmt::format(
        "expected keys before the new frame {}, at which a motion that keeps its length ends, "
        "found {}; --tail extend lets the length change",
        last_frame, text_of(last)));
  }
  keys.push_back({last_frame, last_frame});
  return {};
}

Result<void> check_interval(const Knot& from, const Knot& to, const WarpOptions& options) {
  constexpr double kLeastWidth = 1e-9;  // narrower intervals are one frame, written twice
  if (to.x - from.x < kLeastWidth) {
    return refuse_keys(fmt::format("expected one key for the new frame {}, found {} and {}", to.x,
                                   text_of(from), text_of(to)));
  }
  if (to.y == from.y && !options.allow_hold) {
    return refuse_keys(
        fmt::format("expected keys that go on in the old motion, found {} and {}, between which it "
                    "stands still; --allow-hold allows it",
                    text_of(from), text_of(to)));
  }
  if (to.y < from.y && !options.allow_reverse) {
    return refuse_keys(
        fmt::format("expected keys that go on in the old motion, found {} and {}, between which it "
                    "runs backwards; --allow-reverse allows it",
                    text_of(from), text_of(to)));
  }
  return {};
}

Result<void> check_ease(const WarpOptions& options) {
  const bool is_eased = options.ease.kind != Ease::Kind::None;
  const bool is_straight = options.curve == WarpCurve::Linear;
  if (!is_valid(options.ease)) {
    return refuse_keys(
        "expected an ease with a positive power, or with x1 and x2 from 0 to 1, found other "
        "numbers");
  }
  if (is_eased && !is_straight) {
    return refuse_keys("expected an ease with the linear curve alone, found another curve");
  }
  if (!options.weights.empty() && (is_eased || !is_straight)) {
    return refuse_keys(
        "expected no ease and no curve beside weights, which say by themselves how time runs "
        "between keys");
  }
  if (goes_back(options.ease) && !options.allow_reverse) {
    return refuse_keys(
        "expected an ease that does not go back, found one that overshoots; --allow-reverse "
        "allows it");
  }
  return {};
}

Result<void> check_weights(const std::vector<double>& weights, std::size_t num_frames) {
  if (weights.empty()) return {};
  if (weights.size() != num_frames) {
    return refuse_keys(fmt::format("expected a weight for each of {} frames, found {}", num_frames,
                                   weights.size()));
  }
  const auto is_bad = [](double weight) { return !(weight >= 0 && std::isfinite(weight)); };
  if (std::any_of(weights.begin(), weights.end(), is_bad)) {
    return refuse_keys("expected weights of 0 or more, found another");
  }
  return {};
}

/// The line after the last key if the motion does not keep its length.
Result<StraightTail> tail_after(const std::vector<Knot>& keys, Tail kind, double last_frame) {
  StraightTail tail;
  const Knot last = keys.back();
  if (kind == Tail::Uniform && keys.size() > 1) {
    tail.rise = last.y - keys[keys.size() - 2].y;
    tail.run = last.x - keys[keys.size() - 2].x;
  }
  if (tail.rise == 0) {
    return refuse_keys(
        fmt::format("expected a last interval that moves on, found one that stands still up to "
                    "{}; the uniform tail would never end",
                    text_of(last)));
  }
  tail.end_old = tail.rise > 0 ? last_frame : 0;
  const double end = last.x + (tail.end_old - last.y) * tail.run / tail.rise;
  tail.end = without_rounding(end);
  if (!(tail.end < kMostFrames)) {
    return refuse_keys(
        fmt::format("expected at most {} new frames, found keys that give {}", kMostFrames, end));
  }
  return tail;
}

/// The slopes at the knots of a smooth curve; `tail_rate` is the rate of the line that follows it.
std::vector<double> slopes_for(const std::vector<Knot>& knots, WarpCurve curve,
                               std::optional<double> tail_rate) {
  if (curve == WarpCurve::Linear || knots.size() < 2) return {};
  const bool is_steffen = curve == WarpCurve::Steffen;
  std::vector<double> slopes = is_steffen ? steffen_slopes(knots) : pchip_slopes(knots);
  const std::size_t last = knots.size() - 1;
  if (curve == WarpCurve::Hermite) {
    slopes[0] = monotone_slope(1, knots[0], knots[1]);
    if (!tail_rate) tail_rate = 1;
  }
  if (tail_rate) slopes[last] = monotone_slope(*tail_rate, knots[last - 1], knots[last]);
  return slopes;
}

/// The old frame at a new one between the knots `j` and `j + 1`.
double between_knots(const Plan& plan, std::size_t j, double frame) {
  const Knot& from = plan.knots[j];
  const Knot& to = plan.knots[j + 1];
  if (!plan.slopes.empty()) {
    return on_whole_frame(cubic_at(from, plan.slopes[j], to, plan.slopes[j + 1], frame));
  }
  if (plan.ease.kind == Ease::Kind::None) {
    return on_whole_frame(straight_at(from, to, frame));
  }
  return from.y + ease_at(plan.ease, (frame - from.x) / (to.x - from.x)) * (to.y - from.y);
}

/// Adds the new frames from the knot `j` on, up to the next.
void add_interval(const Plan& plan, std::size_t j, double last_frame,
                  std::vector<double>& old_frames) {
  const Knot& from = plan.knots[j];
  const Knot& to = plan.knots[j + 1];
  double previous = from.y;
  while (static_cast<double>(old_frames.size()) < to.x) {
    const auto frame = static_cast<double>(old_frames.size());
    double old_frame = frame == from.x ? from.y : between_knots(plan, j, frame);
    if (plan.is_curve_monotone) {  // also in spite of rounding
      old_frame = std::clamp(old_frame, std::min(previous, to.y), std::max(previous, to.y));
    }
    previous = old_frame;
    old_frames.push_back(std::clamp(old_frame, 0.0, last_frame));
  }
}

/// Adds the new frames from the last knot on, up to the end.
void add_tail(const Knot& from, const StraightTail& tail, std::vector<double>& old_frames) {
  while (static_cast<double>(old_frames.size()) <= tail.end) {
    const auto frame = static_cast<double>(old_frames.size());
    const double old_frame = on_whole_frame(from.y + (frame - from.x) * tail.rise / tail.run);
    old_frames.push_back(frame == tail.end ? tail.end_old
                                           : std::clamp(old_frame, std::min(from.y, tail.end_old),
                                                        std::max(from.y, tail.end_old)));
  }
}

Result<Plan> plan_for(std::size_t num_frames, const WarpOptions& options) {
  const double last_frame = static_cast<double>(num_frames) - 1;
  auto keys = sorted_keys(options, last_frame);
  if (!keys) return fail(std::move(keys.error()));
  if (options.tail == Tail::Keep) {
    auto kept = keep_length(*keys, last_frame);
    if (!kept) return fail(std::move(kept.error()));
  }
  for (std::size_t j = 0; j + 1 < keys->size(); ++j) {
    auto checked = check_interval((*keys)[j], (*keys)[j + 1], options);
    if (!checked) return fail(std::move(checked.error()));
  }
  Plan plan{std::move(*keys)};
  plan.ease = options.ease;
  plan.is_curve_monotone = !goes_back(options.ease);
  plan.tail.end = plan.knots.back().x;
  plan.tail.end_old = plan.knots.back().y;
  std::optional<double> tail_rate;
  if (options.tail != Tail::Keep) {
    auto tail = tail_after(plan.knots, options.tail, last_frame);
    if (!tail) return fail(std::move(tail.error()));
    plan.tail = *tail;
    tail_rate = tail->rise / tail->run;
  }
  plan.slopes = slopes_for(plan.knots, options.curve, tail_rate);
  if (!options.weights.empty()) {
    auto stretched = stretched_knots(plan.knots, options.weights);
    if (!stretched) return fail(std::move(stretched.error()));
    plan.knots = std::move(*stretched);
  }
  return plan;
}

/// A value interpolated between the neighbouring frames.
double value_at(const std::vector<double>& values, double frame) {
  const auto before = static_cast<std::size_t>(frame);
  const double share = frame - static_cast<double>(before);
  if (share == 0 || before + 1 >= values.size()) return values[std::min(before, values.size() - 1)];
  return on_whole_frame(values[before] + share * (values[before + 1] - values[before]));
}

/// Converts the old frames of keys, and weights, to frames of a steady rate.
/// \param steady  the old frame that each of these frames shows
Result<void> count_steadily(const std::vector<double>& steady, double last_frame,
                            WarpOptions& options) {
  for (WarpKey& key : options.keys) {
    auto checked = check_key({key.new_frame, key.old_frame}, last_frame);
    if (!checked) return checked;
    const FramePosition position = position_in_time(steady, key.old_frame);
    key.old_frame = on_whole_frame(static_cast<double>(position.frame) + position.share);
  }
  if (options.weights.empty()) return {};
  std::vector<double> weights;
  for (const double frame : steady) weights.push_back(value_at(options.weights, frame));
  options.weights = std::move(weights);
  return {};
}

/// The map through keys for frames that have their own times.
Result<TimeMap> warp_by_times(const Timeline& timeline, std::size_t num_frames, WarpOptions options,
                              Diagnostics& diagnostics) {
  const auto rate = rate_for(timeline);
  if (!rate) return fail(rate.error());
  auto checked = check_weights(options.weights, num_frames);
  if (!checked) return fail(std::move(checked.error()));
  Clip clip;
  clip.timeline = timeline;
  clip.num_frames = num_frames;
  const auto steady = steady_map(clip, rate->per_second, time_of_frame(timeline, 0));
  if (!steady) return fail(steady.error());
  const double last_frame = static_cast<double>(num_frames) - 1;
  auto counted = count_steadily(steady->old_frames, last_frame, options);
  if (!counted) return fail(std::move(counted.error()));
  auto map = warp_map(steady->old_frames.size(), options);
  if (!map) return map;
  for (double& frame : map->old_frames) frame = value_at(steady->old_frames, frame);
  map->timeline = steady->timeline;
  diagnostics.add(Severity::Note, "RTM009",
                  fmt::format("frames have times of their own; the motion is shown at {} frames a "
                              "second, in which new frames are counted",
                              rate->per_second));
  return map;
}

/// The new frame of a key in seconds.
double new_frame_at(const Timeline& timeline, double seconds) {
  if (!has_own_times(timeline)) return frame_at_time(timeline, seconds);
  const auto rate = rate_for(timeline);
  return rate ? without_rounding(seconds * rate->per_second) : seconds;
}

}  // namespace

Result<TimeMap> warp_map(const Timeline& timeline, std::size_t num_frames, WarpOptions options,
                         bool keys_in_seconds, Diagnostics& diagnostics) {
  for (WarpKey& key : options.keys) {
    if (!keys_in_seconds) break;
    key = {frame_at_time(timeline, key.old_frame), new_frame_at(timeline, key.new_frame)};
  }
  const bool is_irregular = num_frames > 1 && has_own_times(timeline);
  return is_irregular ? warp_by_times(timeline, num_frames, std::move(options), diagnostics)
                      : warp_map(num_frames, options);
}

Result<TimeMap> warp_map(std::size_t num_frames, const WarpOptions& options) {
  if (static_cast<double>(num_frames) > kMostFrames) {
    return refuse_keys(
        fmt::format("expected at most {} frames, found {}", kMostFrames, num_frames));
  }
  if (num_frames == 0) {
    if (options.keys.empty()) return TimeMap{};
    return refuse_keys("expected a motion with frames to set keys in, found one without");
  }
  for (auto checked : {check_ease(options), check_weights(options.weights, num_frames)}) {
    if (!checked) return fail(std::move(checked.error()));
  }
  auto plan = plan_for(num_frames, options);
  if (!plan) return fail(std::move(plan.error()));

  const double last_frame = static_cast<double>(num_frames) - 1;
  TimeMap map;
  map.old_frames.reserve(static_cast<std::size_t>(plan->tail.end) + 1);
  for (std::size_t j = 0; j + 1 < plan->knots.size(); ++j) {
    add_interval(*plan, j, last_frame, map.old_frames);
  }
  add_tail(plan->knots.back(), plan->tail, map.old_frames);
  return map;
}

}  // namespace kinefile::retime
