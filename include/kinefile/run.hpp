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
/// \errors IO001 if the file cannot be read, those of `parse_servo_map`
Result<ServoMap> read_servo_map(const std::string& path, Diagnostics& diagnostics);

/// Reads a robot's project from a file and makes a servo map from it (see `servo_map_of`).
/// \errors those of `read_project_file`; SVM013 (InvalidInput) if no slider is both shown in
///         degrees and followed by a servo
Result<ServoMap> make_servo_map(const std::string& path, Diagnostics& diagnostics);

/// How to run a flow: options from its robot's project or its servo map, and times in seconds.
struct RunSettings {
  /// An empty `base_pose` or `jumps` is taken from the project; without a project, `base_pose` is
  /// taken from the servo map.
  flow::RunOptions options = {};
  std::shared_ptr<const RobotProject> project = nullptr;
  std::optional<ServoMap> servo_map = std::nullopt;
  /// The length of a tick in microseconds (16667 is read as 1/60 s); absent: that of the project,
  /// otherwise of the servo map, otherwise 1/60 s.
  std::optional<double> tick_us = std::nullopt;
  std::optional<double> hold_seconds = std::nullopt;  ///< replaces `options.hold_ticks`
  std::optional<double> max_seconds = std::nullopt;   ///< replaces `options.max_ticks`
};

/// The maximum length of a run, because runs are kept in memory: two days at 60 ticks per second.
inline constexpr std::uint64_t kMostRunTicks = 10'000'000;

/// A run, and the length of its ticks.
struct TimedRun {
  flow::Run run;
  flow::RunOptions options;  ///< the options of the run
  double tick_seconds = 1.0 / 60;
};

/// Runs a flow (see `flow::run`).
/// \errors those of `flow::run`
Result<TimedRun> run(const PoseFlow& flow, const RunSettings& settings, Diagnostics& diagnostics);

/// A run as joint displacements of a robot or of the joints in the map, or as the motion of a
/// figure.
/// \param map    its `tick_seconds` is that of the run
/// \param model  a robot or a figure whose joints the map names; null: the joints in the map
/// \errors SVM010; those of `model`; DOC001 (Usage) if the model has no skeleton
Result<Document> document_of_run(const TimedRun& run, const ServoMap& map,
                                 const DocumentSource& model, Diagnostics& diagnostics);

/// Makes a flow of poses that approximates a document's motion (see `servo::keyframe`).
/// \param map    for a robot, its joints may be given by link or joint names
/// \param robot  the robot of a body motion; null: joints are matched by the body motion's names,
///               or by the order of the map
/// \errors CLI001 (Usage) for a document without a motion; those of `robot`, of
///         `servo::trajectory_of` and of `servo::keyframe`
Result<servo::Keyframes> keyframe(const Document& document, const ServoMap& map,
                                  const DocumentSource& robot,
                                  const servo::KeyframeOptions& options, Diagnostics& diagnostics);

/// Reads inputs of a person and sensors from CSV: a column "tick", and optional columns "held" (0
/// or 1) and variables "v64"; an empty cell changes nothing.
/// \errors RUN010 to RUN013 (InvalidInput) with their places
Result<std::vector<flow::Input>> parse_inputs(std::string_view text,
                                              const std::string& source_name);

/// How a table of a run shows its sliders.
struct RunTable {
  const TimedRun& run;
  /// The project for degrees and names of sliders; null: words are shown.
  const RobotProject* project = nullptr;
  bool is_relative = false;  ///< degrees relative to the base pose
};

/// Writes a run as CSV: tick, time, one column per slider, and columns sound and servo_off if there
/// are such events. Returns false if the sink returned false.
bool write_run_csv(const RunTable& table, const Sink& sink);

/// A trace of a run as text: one line per block, events, how it ended and the final variables.
std::string trace_of(const PoseFlow& flow, const TimedRun& timed);

}  // namespace kinefile

#pragma GCC visibility pop
