// SPDX-License-Identifier: MIT
#include "flow/machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace kinefile::flow {
namespace {

void store_servo_off(Machine& machine, const std::bitset<kNumServos>& servo_off) {
  const auto bits = static_cast<std::uint32_t>(servo_off.to_ulong());
  machine.variables[kServoOffVariable] = static_cast<std::int16_t>(bits & 0xffff);
  machine.variables[kServoOffVariable + 1] = static_cast<std::int16_t>(bits >> 16);
}

std::bitset<kNumServos> stored_servo_off(const Machine& machine) {
  const auto low = static_cast<std::uint16_t>(machine.variables[kServoOffVariable]);
  const auto high = static_cast<std::uint16_t>(machine.variables[kServoOffVariable + 1]);
  return {(static_cast<std::uint32_t>(high) << 16) | low};
}

bool jumps(const RunOptions& options, std::size_t slider) {
  if (options.jumps.empty()) return jumps_by_default(slider);
  return slider < options.jumps.size() && options.jumps[slider];
}

std::int16_t base_of(const RunOptions& options, std::size_t slider) {
  return slider < options.base_pose.size() ? options.base_pose[slider] : std::int16_t{0};
}

std::int16_t goal_of(const Machine& machine, const SliderWord& word, std::size_t slider) {
  if (word.is_enabled || machine.options.disabled == DisabledWords::File) return word.value;
  if (machine.options.disabled == DisabledWords::Keep) return machine.variables[slider];
  return base_of(machine.options, slider);
}

void set_variables(Machine& machine,
                   const std::vector<std::pair<std::size_t, std::int16_t>>& variables) {
  for (const auto& [number, value] : variables) {
    if (number < kNumVariables) machine.variables[number] = value;
  }
}

void add_row(Machine& machine) {
  machine.run.sliders.append({machine.variables.data(), machine.flow.num_sliders});
}

/// The current words of the sliders and those of a pose; sliders that jump have the new words
/// already.
void aim(Machine& machine, const PoseBlock& pose) {
  for (std::size_t s = 0; s < machine.flow.num_sliders; ++s) {
    machine.to[s] = goal_of(machine, pose.words[s], s);
    machine.from[s] = jumps(machine.options, s) ? machine.to[s] : machine.variables[s];
  }
}

void begin_pose(Machine& machine, std::size_t block, const PoseBlock& pose) {
  if (machine.flow.format == FlowFormat::V1R4) store_servo_off(machine, pose.servo_off);
  note_servos(machine, block);
  if (pose.sound.empty()) return;
  auto& events = machine.run.events;
  const bool is_reported = !events.empty() && events.back().tick == machine.tick &&
                           events.back().block == block && events.back().sound.empty();
  if (!is_reported) events.push_back({machine.tick, block, {}, machine.servo_off, false});
  events.back().sound = pose.sound;
}

std::int32_t result_of(Arithmetic operation, std::int32_t a, std::int32_t b) {
  switch (operation) {
    case Arithmetic::Assign:
      return b;
    case Arithmetic::Add:
      return a + b;
    case Arithmetic::Subtract:
      return a - b;
    case Arithmetic::Multiply:
      return a * b;
    case Arithmetic::Divide:
      return a / b;
  }
  return b;
}

/// Reports something about a block, the first time only.
void warn_once(Machine& machine, std::string code, std::size_t block, std::string message) {
  if (machine.has_warned[block]) return;
  machine.has_warned[block] = true;
  warn(machine, Severity::Warning, std::move(code), block, std::move(message));
}

}  // namespace

Machine start(const PoseFlow& flow, const RunOptions& options, Diagnostics& diagnostics) {
  Machine machine{flow, options, diagnostics};
  machine.visits.resize(flow.blocks.size());
  machine.has_warned.resize(flow.blocks.size());
  machine.from.resize(flow.num_sliders);
  machine.to.resize(flow.num_sliders);
  machine.run.num_sliders = flow.num_sliders;
  for (std::size_t s = 0; s < flow.num_sliders; ++s) machine.variables[s] = base_of(options, s);
  set_variables(machine, options.variables);
  take_inputs(machine);
  add_row(machine);
  return machine;
}

void take_inputs(Machine& machine) {
  const auto& inputs = machine.options.inputs;
  for (; machine.next_input < inputs.size(); ++machine.next_input) {
    const Input& input = inputs[machine.next_input];
    if (input.tick > machine.tick) return;
    if (input.is_held) machine.is_held = input.is_held;
    set_variables(machine, input.variables);
  }
}

bool goes_on(Machine& machine, std::size_t block) {
  if (machine.is_held) return *machine.is_held;
  if (machine.options.hold_ticks) return machine.tick < *machine.options.hold_ticks;
  std::uint64_t& visits = machine.visits[block];
  if (visits < machine.options.num_loops) {
    ++visits;
    return true;
  }
  visits = 0;
  return false;
}

void note_servos(Machine& machine, std::size_t block) {
  if (machine.flow.format != FlowFormat::V1R4) return;  // WORD_N: 62 and 63 are sliders
  const auto servo_off = stored_servo_off(machine);
  if (servo_off == machine.servo_off) return;
  machine.servo_off = servo_off;
  machine.run.events.push_back({machine.tick, block, {}, servo_off, true});
}

bool run_pose(Machine& machine, std::size_t block) {
  const PoseBlock& pose = std::get<PoseBlock>(machine.flow.blocks[block].body);
  const std::size_t num_sliders = machine.flow.num_sliders;
  begin_pose(machine, block, pose);
  aim(machine, pose);
  const int num_ticks = std::max(pose.ticks, 1);
  for (std::int64_t k = 1; k <= num_ticks; ++k) {
    if (machine.tick >= machine.options.max_ticks) return false;
    ++machine.tick;
    take_inputs(machine);
    note_servos(machine, block);
    for (std::size_t s = 0; s < num_sliders; ++s) {
      const std::int64_t way = machine.to[s] - machine.from[s];
      machine.variables[s] = static_cast<std::int16_t>(machine.from[s] + way * k / num_ticks);
    }
    add_row(machine);
  }
  return true;
}

Result<void> compute(Machine& machine, std::size_t block) {
  const auto& sum = std::get<ArithmeticBlock>(machine.flow.blocks[block].body);
  std::int16_t& variable = machine.variables[static_cast<std::size_t>(sum.variable)];
  const std::int32_t operand = sum.has_variable_operand
                                   ? machine.variables[static_cast<std::size_t>(sum.operand)]
                                   : sum.operand;
  if (sum.operation == Arithmetic::Divide && operand == 0) {
    std::string message = fmt::format("block {} divides variable {} by zero at tick {}", block,
                                      sum.variable, machine.tick);
    if (!machine.options.skips_division_by_zero) {
      return fail(block_error(machine.flow, block, "RUN001", std::move(message)));
    }
    warn_once(machine, "RUN001", block, message + "; it is left as it is");
    return {};
  }
  const std::int32_t result = result_of(sum.operation, variable, operand);
  const std::int32_t before = variable;
  variable = static_cast<std::int16_t>(static_cast<std::uint16_t>(result & 0xffff));
  if (variable != result) {
    warn_once(machine, "RUN002", block,
              fmt::format("block {} makes {} of {} in variable {}, which does not fit 16 bits and "
                          "becomes {}",
                          block, result, before, sum.variable, variable));
  }
  note_servos(machine, block);
  return {};
}

bool holds(const BranchBlock& branch, std::int16_t value) {
  switch (branch.condition) {
    case Condition::Undefined:
    case Condition::Never:
      return false;
    case Condition::Always:
      return true;
    case Condition::AtLeast:
      return value >= branch.detail;
    case Condition::AtMost:
      return value <= branch.detail;
    case Condition::Equal:
      return value == branch.detail;
    case Condition::NotEqual:
      return value != branch.detail;
    case Condition::BitsMatch: {
      const int mask = branch.detail & 0xff;
      return (value & mask) == ((branch.detail >> 8) & mask);
    }
  }
  return false;
}

void warn(Machine& machine, Severity severity, std::string code, std::size_t block,
          std::string message) {
  Diagnostic diagnostic = block_error(machine.flow, block, std::move(code), std::move(message));
  diagnostic.severity = severity;
  machine.diagnostics.add(std::move(diagnostic));
}

Error block_error(const PoseFlow& flow, std::size_t block, std::string code, std::string message) {
  Error error = make_error(ErrorKind::InvalidInput, std::move(code), std::move(message));
  error.place.line = flow.blocks[block].line;
  error.place.column = error.place.line > 0 ? 1 : 0;
  return error;
}

}  // namespace kinefile::flow
