// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "flow/machine.hpp"

namespace kinefile::flow {
namespace {

/// Detects cycles of blocks without a pose, by a repeated state (Brent's method: the stored state
/// is replaced after 1, 2, 4, ... steps) or by the number of steps.
class StandstillGuard {
 public:
  explicit StandstillGuard(const Machine& machine) : visits_(machine.visits) {}

  /// Resets the detection after time has passed.
  void reset() { num_steps_ = 0; }

  /// Whether the machine is in a cycle, when it is about to enter a block without time passing.
  bool is_stuck(const Machine& machine, std::size_t block) {
    constexpr std::size_t kMostSteps = 100'000;     // between two poses
    constexpr std::size_t kMostInAll = 10'000'000;  // with poses of one tick between them
    if (num_steps_ > 0 && block == block_ && machine.variables == variables_ &&
        machine.visits == visits_) {
      return true;
    }
    if (num_steps_ == 0 || num_steps_ == renewal_) {
      renewal_ = num_steps_ == 0 ? 1 : renewal_ * 2;
      block_ = block;
      variables_ = machine.variables;
      std::copy(machine.visits.begin(), machine.visits.end(), visits_.begin());
    }
    return ++num_steps_ > kMostSteps || ++num_in_all_ > kMostInAll;
  }

 private:
  std::size_t num_steps_ = 0;
  std::size_t num_in_all_ = 0;
  std::size_t renewal_ = 1;
  std::size_t block_ = 0;
  Variables variables_ = {};
  std::vector<std::uint64_t> visits_;
};

bool is_pose(const Machine& machine, std::size_t block) {
  return std::holds_alternative<PoseBlock>(machine.flow.blocks[block].body);
}

/// Runs a block that takes no time, and records in its step which arrow it follows.
Result<void> run_at_once(Machine& machine, Step& step) {
  const BlockBody& body = machine.flow.blocks[step.block].body;
  if (std::holds_alternative<LoopBlock>(body)) {
    step.takes_branch = !goes_on(machine, step.block);
  } else if (const auto* branch = std::get_if<BranchBlock>(&body)) {
    step.value = machine.variables[static_cast<std::size_t>(branch->variable)];
    const bool is_true = holds(*branch, step.value);
    step.takes_branch = is_true == machine.options.true_takes_branch;
  } else if (const auto* sum = std::get_if<ArithmeticBlock>(&body)) {
    auto computed = compute(machine, step.block);
    if (!computed) return computed;
    step.value = machine.variables[static_cast<std::size_t>(sum->variable)];
  }
  return {};
}

/// Runs a pose. In WORD_N, a pose with a break checks at its end whether to continue.
bool run_timed(Machine& machine, Step& step) {
  if (!run_pose(machine, step.block)) return false;
  if (machine.flow.format == FlowFormat::WordN &&
      machine.flow.blocks[step.block].branch != kNoBlock) {
    step.takes_branch = !goes_on(machine, step.block);
  }
  return true;
}

/// How a flow ends at a block that leads nowhere. In WORD_N this is the normal end.
End end_at(Machine& machine, const Step& step) {
  if (machine.flow.format == FlowFormat::WordN) return End::EndBlock;
  warn(machine, Severity::Note, "RUN005", step.block,
       fmt::format("the flow stops at block {}, whose {} arrow leads nowhere", step.block,
                   step.takes_branch ? "branch" : "normal"));
  return End::NoArrow;
}

End end_of_time(Machine& machine, const Step& step) {
  warn(machine, Severity::Warning, "RUN006", step.block,
       fmt::format("the flow is cut off in block {} after {} ticks, the limit", step.block,
                   machine.tick));
  return End::MaxTicks;
}

/// Runs from a block on until the flow ends.
Result<End> run_from(Machine& machine, int first) {
  StandstillGuard guard(machine);
  auto number = static_cast<std::size_t>(first);
  while (true) {
    const Block& block = machine.flow.blocks[number];
    Step& step = machine.run.path.emplace_back(Step{machine.tick, number});
    if (std::holds_alternative<EndBlock>(block.body)) return End::EndBlock;
    if (is_pose(machine, number)) {
      if (!run_timed(machine, step)) return end_of_time(machine, step);
      guard.reset();
    } else if (guard.is_stuck(machine, number)) {
      return fail(
          block_error(machine.flow, number, "RUN003",
                      fmt::format("the flow goes round without a pose at block {}, tick {}, or "
                                  "through more than 100000 blocks at once",
                                  number, machine.tick)));
    } else if (auto done = run_at_once(machine, step); !done) {
      return fail(std::move(done.error()));
    }
    const int next = step.takes_branch ? block.branch : block.normal;
    if (next == kNoBlock) return end_at(machine, step);
    number = static_cast<std::size_t>(next);
  }
}

}  // namespace

RunOptions run_options_of(const RobotProject& project) {
  RunOptions options;
  options.base_pose = base_values(project);
  for (const Slider& slider : project.sliders) options.jumps.push_back(slider.jumps);
  return options;
}

Result<Run> run(const PoseFlow& flow, const RunOptions& options, Diagnostics& diagnostics) {
  const int first = first_block(flow);
  if (first == kNoBlock) {
    return fail(make_error(ErrorKind::InvalidInput, "RUN004",
                           flow.format == FlowFormat::WordN
                               ? "expected a pose to begin with, found none"
                               : "expected a start block, found none"));
  }
  Machine machine = start(flow, options, diagnostics);
  const auto end = run_from(machine, first);
  if (!end) return fail(end.error());
  machine.run.end = *end;
  machine.run.num_ticks = static_cast<std::size_t>(machine.tick);
  machine.run.variables = machine.variables;
  return std::move(machine.run);
}

}  // namespace kinefile::flow
