// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "kinefile/kinefile.hpp"

namespace kinefile::cli {

/// A time of a flow; ticks of 1/60 s give what 60 divides.
double seconds_of(std::uint64_t tick, double tick_seconds);

/// What a table of a run shows of its sliders.
struct RunTable {
  const flow::Run& run;
  double tick_seconds = 1.0 / 60;
  /// Of which degrees are shown, under the names of sliders; null: words.
  const RobotProject* project = nullptr;
  bool is_relative = false;  ///< degrees from the base pose on
};

/// Writes a run as CSV: tick, time, a column a slider, and columns sound and servo_off if there
/// are such events. Returns false if the sink did.
bool write_run_csv(const RunTable& table, const Sink& sink);

/// The way that a run took, a line a block, its events, how it ended and what it left behind.
/// \param options  how it was run
std::string trace_of(const PoseFlow& flow, const flow::Run& run, const flow::RunOptions& options,
                     double tick_seconds);

}  // namespace kinefile::cli
