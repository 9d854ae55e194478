// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/flow.hpp"
#include "kinefile/process.hpp"
#include "kinefile/servo.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// Reads a servo map from a file.
/// \errors IO001 if the file cannot be read, else those of `parse_servo_map`
Result<ServoMap> read_servo_map(const std::string& path, Diagnostics& diagnostics);

/// Makes a servo map of a robot's project (see `servo_map_of`), which is read from a file.
/// \errors those of `read_project_file`; SVM013 (InvalidInput) if no slider is shown in degrees
///         while a servo follows it
Result<ServoMap> make_servo_map(const std::string& path, Diagnostics& diagnostics);

/// How to run a flow: what its robot's project or its servo map says, and times in seconds.
struct RunSettings {
  /// Where `base_pose` and `jumps` are empty, the project says them, else the servo map the first.
  flow::RunOptions options = {};
  std::shared_ptr<const RobotProject> project = nullptr;
  std::optional<ServoMap> servo_map = std::nullopt;
  /// A tick in microseconds, 16667 of which are 1/60 s; absent: the project's, else the servo
  /// map's, else 1/60 s.
  std::optional<double> tick_us = std::nullopt;
  std::optional<double> hold_seconds = std::nullopt;  ///< instead of `options.hold_ticks`
  std::optional<double> max_seconds = std::nullopt;   ///< instead of `options.max_ticks`
};

/// The longest run, which is kept in memory: two days at 60 ticks a second.
inline constexpr std::uint64_t kMostRunTicks = 10'000'000;

/// What a flow did, and how long a tick took.
struct TimedRun {
  flow::Run run;
  flow::RunOptions options;  ///< with which it was run
  double tick_seconds = 1.0 / 60;
};

/// Runs a flow (see `flow::run`).
/// \errors those of `flow::run`
Result<TimedRun> run(const PoseFlow& flow, const RunSettings& settings, Diagnostics& diagnostics);

/// What a run did, as displacements of the joints of a robot, or of the map's; or as the motion of
/// a figure.
/// \param map    `tick_seconds` is the run's
/// \param model  a robot or a figure whose joints the map names; null: the map's joints
/// \errors SVM010; those of `model`; DOC001 (Usage) if what it gives has no skeleton
Result<Document> document_of_run(const TimedRun& run, const ServoMap& map,
                                 const DocumentSource& model, Diagnostics& diagnostics);

/// Makes a flow of poses that follows a document's motion (see `servo::keyframe`).
/// \param map    a robot's links may be called by the names of their joints
/// \param robot  of a body motion; null: its own names of joints, or the order of the map
/// \errors CLI001 (Usage) for a document without a motion; those of `robot`, of
///         `servo::trajectory_of` and of `servo::keyframe`
Result<servo::Keyframes> keyframe(const Document& document, const ServoMap& map,
                                  const DocumentSource& robot,
                                  const servo::KeyframeOptions& options, Diagnostics& diagnostics);

/// Reads what a person and sensors do from CSV: a column "tick", and as they apply "held" (0 or 1)
/// and variables "v64"; an empty cell changes nothing.
/// \errors RUN010 to RUN013 (InvalidInput) with their places
Result<std::vector<flow::Input>> parse_inputs(std::string_view text,
                                              const std::string& source_name);

/// What a table of a run shows of its sliders.
struct RunTable {
  const TimedRun& run;
  /// Of which degrees are shown, under the names of sliders; null: words.
  const RobotProject* project = nullptr;
  bool is_relative = false;  ///< degrees from the base pose on
};

/// Writes a run as CSV: tick, time, a column a slider, and columns sound and servo_off if there
/// are such events. Returns false if the sink did.
bool write_run_csv(const RunTable& table, const Sink& sink);

/// The way that a run took, a line a block, its events, how it ended and what it left behind.
std::string trace_of(const PoseFlow& flow, const TimedRun& run);

}  // namespace kinefile

#pragma GCC visibility pop
