// SPDX-License-Identifier: MIT
// The state of the robot that runs a flow: its variables, the time, and the events so far.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kinefile/flow.hpp"

namespace kinefile::flow {

/// The sliders that take new values at once unless a project says otherwise: the voice, the
/// selectors of lights and the digital outputs, whose words are not positions.
constexpr bool jumps_by_default(std::size_t slider) {
  return slider == 30 || (slider >= 37 && slider <= 40);
}

using Variables = std::array<std::int16_t, kNumVariables>;

/// The variables that hold which servos are without power: channels 0 to 15, and the others.
inline constexpr std::size_t kServoOffVariable = 62;

/// A robot. The first variables are its sliders.
struct Machine {
  const PoseFlow& flow;
  const RunOptions& options;
  Diagnostics& diagnostics;
  Variables variables = {};
  std::vector<std::uint64_t> visits =
      {};  ///< by block: how often it followed the normal arrow since the last branch
  std::uint64_t tick = 0;
  std::size_t next_input = 0;
  std::optional<bool> is_held = {};  ///< from an input
  std::bitset<kNumServos> servo_off = {};
  std::vector<bool> has_warned = {};             ///< by block
  std::vector<std::int16_t> from = {}, to = {};  ///< buffers for the sliders of a pose
  Run run = {};
};

/// A robot that stands in its base pose at tick 0.
Machine start(const PoseFlow& flow, const RunOptions& options, Diagnostics& diagnostics);

/// Applies the inputs of this tick.
void take_inputs(Machine& machine);

/// Whether a loop continues: by the button, or by its number of repetitions. Counts a visit.
bool goes_on(Machine& machine, std::size_t block);

/// Adds an event for variables 62 and 63, if their servo states have changed.
void note_servos(Machine& machine, std::size_t block);

/// Moves the sliders to a pose, tick by tick. Returns false if the time limit is reached.
bool run_pose(Machine& machine, std::size_t block);

/// Computes a block's result and stores it.
/// \errors RUN001
Result<void> compute(Machine& machine, std::size_t block);

/// Whether a branch block's condition holds.
bool holds(const BranchBlock& branch, std::int16_t value);

/// Reports something about a block, at its line.
void warn(Machine& machine, Severity severity, std::string code, std::size_t block,
          std::string message);
Error block_error(const PoseFlow& flow, std::size_t block, std::string code, std::string message);

}  // namespace kinefile::flow
