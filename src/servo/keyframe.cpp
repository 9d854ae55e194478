// SPDX-License-Identifier: MIT
// Converts a trajectory to a flow of poses: the words at every tick, the ticks of poses
// (keyframe_search.cpp), and the error of the running flow.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinefile/flow.hpp"
#include "kinefile/servo.hpp"
#include "servo/keyframe_search.hpp"

namespace kinefile::servo {
namespace {

/// In frames: a tick this close to a frame counts as the frame.
constexpr double kFrameMargin = 1e-6;

Error usage(std::string message) {
  return make_error(ErrorKind::Usage, "KEY001", std::move(message));
}

/// The map's entries for a trajectory's joints, and the trajectory in words.
struct Task {
  std::vector<const ServoMapEntry*> entries;  ///< by joint of the trajectory
  WordTrack track;
  double tick_seconds = 0;
};

Result<void> check_options(const KeyframeOptions& options, const ServoMap& map) {
  if (options.num_poses.has_value() == options.tolerance.has_value()) {
    return fail(usage("expected either a number of poses or a tolerance"));
  }
  if (options.tolerance && !(*options.tolerance >= 0)) {
    return fail(
        usage(fmt::format("expected a tolerance from 0 degrees up, found {}", *options.tolerance)));
  }
  if (options.lead_in_ticks < 1 || options.lead_in_ticks > kMaxTicks) {
    return fail(usage(fmt::format("expected a lead-in of 1 to {} ticks, found {}", kMaxTicks,
                                  options.lead_in_ticks)));
  }
  const std::size_t most = max_sliders(options.format);
  if (map.num_sliders >= 1 && map.num_sliders <= most) return {};
  return fail(usage(fmt::format("expected a servo map of 1 to {} sliders, as {} has, found {}",
                                most, header_word(options.format), map.num_sliders)));
}

/// The words that an entry can have: the lowest, the highest, on its steps.
struct Grid {
  int lowest, highest, step;

  explicit Grid(const ServoMapEntry& entry)
      : lowest(entry.minimum),
        highest(entry.minimum + (entry.maximum - entry.minimum) / entry.step * entry.step),
        step(entry.step) {}

  std::int16_t nearest(double word) const {
    const double limited =
        std::clamp(word, static_cast<double>(lowest), static_cast<double>(highest));
    return static_cast<std::int16_t>(lowest + step * std::lround((limited - lowest) / step));
  }
  /// The excess of a word over its limits, except for rounding.
  double excess(double word) const {
    const double beyond = std::max(lowest - word, word - highest);
    return beyond > step * 0.5 ? beyond : 0;
  }
};

bool is_good(const ServoMapEntry& entry, std::size_t num_sliders) {
  return entry.slider < num_sliders && entry.step >= 1 && entry.minimum <= entry.maximum &&
         entry.minimum >= INT16_MIN && entry.maximum <= INT16_MAX && entry.units_per_degree > 0;
}

Result<std::vector<const ServoMapEntry*>> entries_of(const JointTrajectory& trajectory,
                                                     const ServoMap& map) {
  std::vector<const ServoMapEntry*> entries;
  for (const std::string& joint : trajectory.joints) {
    const auto found =
        std::find_if(map.entries.begin(), map.entries.end(),
                     [&](const ServoMapEntry& entry) { return entry.joint == joint; });
    if (found == map.entries.end() || !is_good(*found, map.num_sliders)) {
      return fail(make_error(ErrorKind::Usage, "SVM010",
                             fmt::format("expected joint '{}' in the servo map, with a slider of "
                                         "it and limits, found none",
                                         joint)));
    }
    entries.push_back(&*found);
  }
  if (entries.empty()) {
    return fail(make_error(ErrorKind::Usage, "SVM010",
                           "expected joints of the servo map in the trajectory, found none"));
  }
  return entries;
}

/// The angle of a joint at a tick: linear between frames, that of the last frame at the end.
double angle_at(const JointTrajectory& trajectory, std::size_t joint, double frame) {
  const double whole = std::round(frame);
  if (std::abs(frame - whole) <= kFrameMargin) frame = whole;
  const std::size_t num_joints = trajectory.joints.size();
  const std::size_t before = std::min(static_cast<std::size_t>(frame), trajectory.num_frames - 1);
  const double share = frame - static_cast<double>(before);
  const double from = trajectory.angles[before * num_joints + joint];
  if (share == 0 || before + 1 == trajectory.num_frames) return from;
  return from + (trajectory.angles[(before + 1) * num_joints + joint] - from) * share;
}

void report_limits(const Task& task, Diagnostics& diagnostics, const JointTrajectory& trajectory) {
  const WordTrack& track = task.track;
  for (std::size_t j = 0; j < track.num_joints; ++j) {
    const Grid grid(*task.entries[j]);
    double largest = 0;
    std::size_t when = 0;
    for (std::size_t tick = 0; tick <= track.last_tick; ++tick) {
      const double excess = grid.excess(track.targets[tick * track.num_joints + j]);
      if (excess <= largest) continue;
      largest = excess;
      when = tick;
    }
    if (largest == 0) continue;
    diagnostics.add(
        Severity::Warning, "KEY003",
        fmt::format("joint '{}' goes beyond the limits of slider {}: up to {:.3g} degrees are cut "
                    "off (at {:.3f} s)",
                    trajectory.joints[j], task.entries[j]->slider, largest * track.degrees_each[j],
                    static_cast<double>(when) * task.tick_seconds));
  }
}

Result<Task> task_of(const JointTrajectory& trajectory, const ServoMap& map) {
  Task task;
  task.tick_seconds = map.tick_seconds;
  auto entries = entries_of(trajectory, map);
  if (!entries) return fail(std::move(entries.error()));
  task.entries = std::move(*entries);
  if (trajectory.num_frames == 0) {
    return fail(make_error(ErrorKind::InvalidInput, "KEY001", "expected frames, found none"));
  }
  const double frames = static_cast<double>(trajectory.num_frames - 1);
  const auto num_ticks =
      num_ticks_of(frames == 0 ? 0 : frames * trajectory.frame_time, map.tick_seconds);
  if (!num_ticks) return fail(num_ticks.error());
  WordTrack& track = task.track;
  track.num_joints = task.entries.size();
  track.last_tick = *num_ticks;
  for (const ServoMapEntry* entry : task.entries) {
    track.degrees_each.push_back(1 / entry->units_per_degree);
  }
  for (std::size_t tick = 0; tick <= track.last_tick; ++tick) {
    const double seconds = static_cast<double>(tick) * map.tick_seconds;
    const double frame = frames == 0 ? 0 : seconds / trajectory.frame_time;
    for (std::size_t j = 0; j < track.num_joints; ++j) {
      const double word = word_of_angle(*task.entries[j], angle_at(trajectory, j, frame));
      if (!std::isfinite(word)) {
        return fail(make_error(ErrorKind::InvalidInput, "KEY004",
                               fmt::format("expected angles, found none of joint '{}' at {:.3f} s",
                                           trajectory.joints[j], seconds)));
      }
      track.targets.push_back(word);
      track.words.push_back(Grid(*task.entries[j]).nearest(word));
    }
  }
  return task;
}

/// The errors of a flow relative to the trajectory, as `flow::run` runs it.
Result<std::vector<KeyframeError>> errors_of(const PoseFlow& flow,
                                             const JointTrajectory& trajectory, const Task& task,
                                             const KeyframeOptions& options) {
  flow::RunOptions run_options;
  run_options.jumps.assign(flow.num_sliders, false);  // sliders of servos do not jump
  run_options.max_ticks += kMaxTicks;                 // the lead-in
  Diagnostics none;
  const auto run = flow::run(flow, run_options, none);
  if (!run) return fail(run.error());
  const WordTrack& track = task.track;
  const auto lead_in = static_cast<std::size_t>(options.lead_in_ticks);
  std::vector<KeyframeError> errors;
  for (std::size_t j = 0; j < track.num_joints; ++j) {
    KeyframeError& error = errors.emplace_back();
    error.joint = trajectory.joints[j];
    double sum = 0;
    for (std::size_t tick = 0; tick <= track.last_tick; ++tick) {
      const std::int16_t word =
          run->sliders[(lead_in + tick) * run->num_sliders + task.entries[j]->slider];
      const double off =
          std::abs(word - track.targets[tick * track.num_joints + j]) * track.degrees_each[j];
      sum += off * off;
      if (off <= error.largest) continue;
      error.largest = off;
      error.largest_seconds = static_cast<double>(tick) * task.tick_seconds;
    }
    error.rms = std::sqrt(sum / static_cast<double>(track.last_tick + 1));
  }
  return errors;
}

PoseBlock pose_at(const Task& task, std::size_t tick, int ticks, std::size_t num_sliders) {
  PoseBlock pose;
  pose.ticks = ticks;
  pose.words.resize(num_sliders);
  for (std::size_t j = 0; j < task.entries.size(); ++j) {
    pose.words[task.entries[j]->slider] = {task.track.words[tick * task.entries.size() + j], true};
  }
  return pose;
}

/// Poses in sequence, as in WORD_N.
PoseFlow flow_of(const Task& task, const KeyTicks& keys, const ServoMap& map,
                 const KeyframeOptions& options) {
  PoseFlow flow;
  flow.format = FlowFormat::WordN;
  flow.num_sliders = map.num_sliders;
  for (std::size_t i = 0; i < keys.ticks.size(); ++i) {
    const int ticks =
        i == 0 ? options.lead_in_ticks : static_cast<int>(keys.ticks[i] - keys.ticks[i - 1]);
    Block& block = flow.blocks.emplace_back();
    block.normal = i + 1 < keys.ticks.size() ? static_cast<int>(i) + 1 : kNoBlock;
    block.body = pose_at(task, keys.ticks[i], ticks, map.num_sliders);
  }
  return flow;
}

Result<Keyframes> keyframes_of(const JointTrajectory& trajectory, const Task& task,
                               const KeyTicks& keys, const ServoMap& map,
                               const KeyframeOptions& options) {
  Diagnostics none;
  auto flow = flow::in_format(flow_of(task, keys, map, options), options.format, none);
  if (!flow) return fail(std::move(flow.error()));
  auto errors = errors_of(*flow, trajectory, task, options);
  if (!errors) return fail(std::move(errors.error()));
  return Keyframes{std::move(*flow), keys.ticks, std::move(*errors)};
}

/// A trajectory clipped to the limits, because no poses can exceed them. Otherwise one joint far
/// beyond its limits would hide the errors of all others.
WordTrack within_limits(const Task& task) {
  WordTrack track = task.track;
  for (std::size_t i = 0; i < track.targets.size(); ++i) {
    const Grid grid(*task.entries[i % track.num_joints]);
    track.targets[i] = std::clamp(track.targets[i], static_cast<double>(grid.lowest),
                                  static_cast<double>(grid.highest));
  }
  return track;
}

/// The error if no poses meet a tolerance: the place where even the closest ones exceed it.
Error out_of_tolerance(const JointTrajectory& trajectory, const Task& task, const ServoMap& map,
                       const KeyframeOptions& options) {
  const KeyTicks keys = closest_poses(task.track, task.track.last_tick + 1);
  const auto closest = keyframes_of(trajectory, task, keys, map, options);
  if (!closest) return closest.error();
  const auto worst = std::max_element(
      closest->errors.begin(), closest->errors.end(),
      [](const KeyframeError& a, const KeyframeError& b) { return a.largest < b.largest; });
  return make_error(
      ErrorKind::InvalidInput, "KEY002",
      fmt::format("expected words within {} degrees of the trajectory, found that those of joint "
                  "'{}', rounded and limited as the servo map says, come no nearer than {:.4g} "
                  "degrees (at {:.3f} s)",
                  *options.tolerance, worst->joint, worst->largest, worst->largest_seconds));
}

}  // namespace

Result<Keyframes> keyframe(const JointTrajectory& trajectory, const ServoMap& map,
                           const KeyframeOptions& options, Diagnostics& diagnostics) {
  if (auto checked = check_options(options, map); !checked) return fail(checked.error());
  const auto task = task_of(trajectory, map);
  if (!task) return fail(task.error());
  report_limits(*task, diagnostics, trajectory);
  if (options.tolerance) {
    const auto keys = fewest_poses(task->track, *options.tolerance);
    if (!keys) return fail(out_of_tolerance(trajectory, *task, map, options));
    return keyframes_of(trajectory, *task, *keys, map, options);
  }
  const std::size_t least = least_poses(task->track);
  if (*options.num_poses < least) {
    return fail(
        usage(fmt::format("expected at least {} poses, since none takes longer than {} "
                          "ticks, found {}",
                          least, kMaxTicks, *options.num_poses)));
  }
  const KeyTicks keys = closest_poses(within_limits(*task), *options.num_poses);
  return keyframes_of(trajectory, *task, keys, map, options);
}

}  // namespace kinefile::servo
