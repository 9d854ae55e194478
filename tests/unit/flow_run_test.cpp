// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "support/flows.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

using Path = std::vector<std::size_t>;

flow::RunOptions loops(std::uint64_t count) {
  flow::RunOptions options;
  options.num_loops = count;
  return options;
}

Error run_fault(const PoseFlow& flow, const flow::RunOptions& options = {}) {
  Diagnostics diagnostics;
  const auto run = flow::run(flow, options, diagnostics);
  EXPECT_FALSE(run);
  return run ? Error{} : run.error();
}

std::string noticed_by(const PoseFlow& flow, const flow::RunOptions& options = {}) {
  Diagnostics diagnostics;
  const auto run = flow::run(flow, options, diagnostics);
  EXPECT_TRUE(run);
  return text_of(diagnostics);
}

TEST(RunFlow, LoopsOfWordNAsTheFactsSay) {
  EXPECT_EQ(run_of(word_n_loop(), loops(0)).num_ticks, 80u);
  EXPECT_EQ(run_of(word_n_loop(), loops(1)).num_ticks, 100u);
  EXPECT_EQ(run_of(word_n_loop(), loops(3)).num_ticks, 140u);
  EXPECT_EQ(path_of(run_of(word_n_loop(), loops(1))), (Path{0, 1, 2, 1, 3}));
}

TEST(RunFlow, LoopsOfV1R4AsTheFactsSay) {
  EXPECT_EQ(run_of(v1r4_loop(), loops(0)).num_ticks, 90u);
  EXPECT_EQ(run_of(v1r4_loop(), loops(1)).num_ticks, 110u);
  EXPECT_EQ(run_of(v1r4_loop(), loops(3)).num_ticks, 150u);
  EXPECT_EQ(path_of(run_of(v1r4_loop(), loops(1))), (Path{0, 1, 2, 3, 4, 2, 3, 4, 5, 6}));
}

TEST(RunFlow, CountsInAVariable) {
  const flow::Run run = run_of(v1r4_counter());
  EXPECT_EQ(run.num_ticks, 60u);
  EXPECT_EQ(run.variables[64], 3);
  EXPECT_EQ(run.end, flow::End::EndBlock);
  EXPECT_EQ(path_of(run), (Path{0, 1, 2, 3, 4, 5, 2, 3, 4, 5, 2, 3, 4, 5, 6}));
  EXPECT_EQ(run.path[4].value, 1);
  EXPECT_FALSE(run.path[5].takes_branch);
  EXPECT_EQ(run.path[13].value, 3);
  EXPECT_TRUE(run.path[13].takes_branch);
  EXPECT_EQ(run.path[14].tick, 60u);
}

TEST(RunFlow, GoesOnALineInWholeNumbersTowardsZero) {
  const PoseFlow flow = word_n_of({pose_block(4, {10, -10}, 1), pose_block(2, {9, 7}, kNoBlock)});
  const flow::Run run = run_of(flow);
  EXPECT_EQ(slider_of(run, 0), (std::vector<int>{0, 2, 5, 7, 10, 10, 9}));
  EXPECT_EQ(slider_of(run, 1), (std::vector<int>{0, -2, -5, -7, -10, -2, 7}));
}

TEST(RunFlow, CrossesTheWholeRangeWithoutWrapping) {
  const PoseFlow flow = word_n_of({pose_block(1, {-32768}, 1), pose_block(239, {32767}, kNoBlock)});
  const std::vector<int> values = slider_of(run_of(flow), 0);
  EXPECT_EQ(values[1], -32768);
  EXPECT_EQ(values[2], -32768 + 65535 / 239);
  EXPECT_EQ(values[240], 32767);
}

TEST(RunFlow, SlidersThatJumpDoAtTheFirstTick) {
  std::vector<int> values(41, 90);
  const PoseFlow flow = word_n_of({pose_block(3, values, kNoBlock)});
  const flow::Run run = run_of(flow);
  for (const std::size_t slider : {30u, 37u, 40u}) EXPECT_EQ(run.sliders[41 + slider], 90);
  for (const std::size_t slider : {0u, 29u, 31u, 36u}) EXPECT_EQ(run.sliders[41 + slider], 30);
  flow::RunOptions options;
  options.jumps = {true};
  const flow::Run other = run_of(flow, options);
  EXPECT_EQ(other.sliders[41 + 0], 90);
  EXPECT_EQ(other.sliders[41 + 30], 30);
}

TEST(RunFlow, DisabledWordsTakeTheBasePoseOrWhatIsAskedFor) {
  PoseFlow flow = word_n_of({pose_block(1, {500}, 1), pose_block(1, {70}, kNoBlock)});
  pose_of(flow.blocks[1]).words[0].is_enabled = false;
  flow::RunOptions options;
  options.base_pose = {-9};
  EXPECT_EQ(slider_of(run_of(flow, options), 0), (std::vector<int>{-9, 500, -9}));
  options.disabled = flow::DisabledWords::Keep;
  EXPECT_EQ(slider_of(run_of(flow, options), 0), (std::vector<int>{-9, 500, 500}));
  options.disabled = flow::DisabledWords::File;
  EXPECT_EQ(slider_of(run_of(flow, options), 0), (std::vector<int>{-9, 500, 70}));
}

TEST(RunFlow, AButtonIsHeldForAWhile) {
  flow::RunOptions options = loops(5);
  options.hold_ticks = 60;  // pose 2 is done at 60, when it is released
  EXPECT_EQ(run_of(v1r4_loop(), options).num_ticks, 90u);
  options.hold_ticks = 61;
  EXPECT_EQ(run_of(v1r4_loop(), options).num_ticks, 110u);
}

TEST(RunFlow, InputsStandInsteadOfLoops) {
  flow::RunOptions options = loops(100);
  options.inputs = {{0, true, {}}, {85, false, {}}};
  EXPECT_EQ(run_of(v1r4_loop(), options).num_ticks, 130u);
  options.inputs = {{0, std::nullopt, {{64, 7}}}, {20, false, {}}};
  const flow::Run run = run_of(v1r4_loop(), options);
  EXPECT_EQ(run.num_ticks, 90u);
  EXPECT_EQ(run.variables[64], 7);
}

TEST(RunFlow, ASensorDecidesAtTheTickWhenABlockAsks) {
  const PoseFlow flow = v1r4_of({start_block(1), pose_block(10, {1}, 2),
                                 branch_block(139, Condition::AtLeast, 100, 1, 3), end_block()});
  flow::RunOptions options;
  options.inputs = {{20, std::nullopt, {{139, 100}}}};
  EXPECT_EQ(run_of(flow, options).num_ticks, 20u);
  options.inputs = {{21, std::nullopt, {{139, 100}}}};
  EXPECT_EQ(run_of(flow, options).num_ticks, 30u);
}

TEST(RunFlow, ALoopCountsAnewAfterItLeft) {
  // An inner loop of two rounds within an outer one that runs once more.
  const PoseFlow flow = v1r4_of(
      {start_block(1), pose_block(10, {1}, 2), loop_block(1, 3), loop_block(1, 4), end_block()});
  EXPECT_EQ(run_of(flow, loops(1)).num_ticks, 40u);
}

TEST(RunFlow, KnowsEveryCondition) {
  const auto is_true = [](Condition condition, int detail, std::int16_t value) {
    const PoseFlow flow = v1r4_of(
        {start_block(1), branch_block(64, condition, detail, 2, 3), end_block(), end_block()});
    flow::RunOptions options;
    options.variables = {{64, value}};
    return path_of(run_of(flow, options)).back() == 3;
  };
  EXPECT_FALSE(is_true(Condition::Undefined, 0, 0));
  EXPECT_TRUE(is_true(Condition::AtLeast, 5, 5));
  EXPECT_FALSE(is_true(Condition::AtLeast, 5, 4));
  EXPECT_TRUE(is_true(Condition::AtMost, -5, -5));
  EXPECT_FALSE(is_true(Condition::AtMost, -5, -4));
  EXPECT_TRUE(is_true(Condition::Equal, -1, -1));
  EXPECT_FALSE(is_true(Condition::Equal, -1, 1));
  EXPECT_TRUE(is_true(Condition::NotEqual, 0, 1));
  EXPECT_FALSE(is_true(Condition::NotEqual, 1, 1));
  EXPECT_TRUE(is_true(Condition::Always, 0, 0));
  EXPECT_FALSE(is_true(Condition::Never, 0, 0));
  // Bits 0x30 of a byte are looked at; 0x10 is wanted.
  EXPECT_TRUE(is_true(Condition::BitsMatch, 0x1030, 0x1f));
  EXPECT_FALSE(is_true(Condition::BitsMatch, 0x1030, 0x3f));
  EXPECT_TRUE(is_true(Condition::BitsMatch, -32640, 0x0080));  // 0x8080
  EXPECT_TRUE(is_true(Condition::BitsMatch, -32640, -128));
  EXPECT_FALSE(is_true(Condition::BitsMatch, -32640, 0x7f));
}

TEST(RunFlow, BranchesTheOtherWayIfAskedTo) {
  flow::RunOptions options;
  options.true_takes_branch = false;
  EXPECT_EQ(run_of(v1r4_counter(), options).num_ticks, 20u);
}

std::int16_t computed(Arithmetic operation, int constant, std::int16_t value) {
  const PoseFlow flow =
      v1r4_of({start_block(1), constant_block(70, operation, constant, 2), end_block()});
  flow::RunOptions options;
  options.variables = {{70, value}};
  return run_of(flow, options).variables[70];
}

TEST(RunFlow, ComputesInSixteenBits) {
  EXPECT_EQ(computed(Arithmetic::Assign, -7, 3), -7);
  EXPECT_EQ(computed(Arithmetic::Add, 4, 3), 7);
  EXPECT_EQ(computed(Arithmetic::Subtract, 4, 3), -1);
  EXPECT_EQ(computed(Arithmetic::Multiply, -4, 3), -12);
  EXPECT_EQ(computed(Arithmetic::Divide, 2, -7), -3);
  EXPECT_EQ(computed(Arithmetic::Divide, -2, 7), -3);
  EXPECT_EQ(computed(Arithmetic::Add, 1, 32767), -32768);
  EXPECT_EQ(computed(Arithmetic::Multiply, -32768, -32768), 0);
  EXPECT_EQ(computed(Arithmetic::Divide, -1, -32768), -32768);
}

TEST(RunFlow, ComputesWithVariables) {
  const PoseFlow flow = v1r4_of({start_block(1), variable_block(70, Arithmetic::Subtract, 71, 2),
                                 variable_block(70, Arithmetic::Multiply, 70, 3), end_block()});
  flow::RunOptions options;
  options.variables = {{70, 5}, {71, 8}};
  EXPECT_EQ(run_of(flow, options).variables[70], 9);
}

TEST(RunFlow, WarnsOfAnOverflowOncePerBlock) {
  const PoseFlow flow = v1r4_of({start_block(1), constant_block(70, Arithmetic::Add, 30000, 2),
                                 pose_block(1, {0}, 3), loop_block(1, 4), end_block()});
  EXPECT_EQ(noticed_by(flow, loops(6)),
            ":20:1: warning[RUN002]: block 1 makes 60000 of 30000 in variable 70, which does not "
            "fit 16 bits and becomes -5536\n");
}

TEST(RunFlow, RefusesToDivideByZeroUnlessAskedTo) {
  const PoseFlow flow = v1r4_of({start_block(1), pose_block(3, {0}, 2),
                                 variable_block(70, Arithmetic::Divide, 71, 3), end_block()});
  flow::RunOptions options;
  options.variables = {{70, 5}};
  const Error fault = run_fault(flow, options);
  EXPECT_EQ(to_string(fault),
            ":30:1: error[RUN001]: block 2 divides variable 70 by zero at tick 3");
  EXPECT_EQ(fault.kind, ErrorKind::InvalidInput);
  options.skips_division_by_zero = true;
  EXPECT_EQ(run_of(flow, options).variables[70], 5);
  EXPECT_EQ(noticed_by(flow, options),
            ":30:1: warning[RUN001]: block 2 divides variable 70 by zero at tick 3; it is left as "
            "it is\n");
}

TEST(RunFlow, SlidersAreVariables) {
  const PoseFlow flow =
      v1r4_of({start_block(1), pose_block(2, {100}, 2), constant_block(0, Arithmetic::Add, 50, 3),
               variable_block(64, Arithmetic::Assign, 0, 4), pose_block(2, {250}, 5), end_block()});
  const flow::Run run = run_of(flow);
  EXPECT_EQ(slider_of(run, 0), (std::vector<int>{0, 50, 100, 200, 250}));
  EXPECT_EQ(run.variables[64], 150);
}

TEST(RunFlow, TellsSoundsAndServosWhenAPoseBegins) {
  PoseFlow flow = v1r4_of({start_block(1), pose_block(5, {0}, 2), pose_block(5, {0}, 3),
                           pose_block(5, {0}, 4), end_block()});
  pose_of(flow.blocks[2]).sound = "drum.wav";
  pose_of(flow.blocks[2]).servo_off[0] = true;
  pose_of(flow.blocks[2]).servo_off[29] = true;
  pose_of(flow.blocks[3]).servo_off = pose_of(flow.blocks[2]).servo_off;
  pose_of(flow.blocks[3]).sound = "clap.wav";
  const flow::Run run = run_of(flow);
  ASSERT_EQ(run.events.size(), 2u);
  EXPECT_EQ(run.events[0].tick, 5u);
  EXPECT_EQ(run.events[0].block, 2u);
  EXPECT_EQ(run.events[0].sound, "drum.wav");
  EXPECT_TRUE(run.events[0].changes_servos);
  EXPECT_TRUE(run.events[0].servo_off[29]);
  EXPECT_EQ(run.events[1].tick, 10u);
  EXPECT_EQ(run.events[1].sound, "clap.wav");
  EXPECT_FALSE(run.events[1].changes_servos);
  EXPECT_EQ(run.variables[62], 1);
  EXPECT_EQ(run.variables[63], 1 << 13);
}

TEST(RunFlow, ArithmeticSwitchesServos) {
  const PoseFlow flow =
      v1r4_of({start_block(1), constant_block(62, Arithmetic::Assign, -32768, 2), end_block()});
  const flow::Run run = run_of(flow);
  ASSERT_EQ(run.events.size(), 1u);
  EXPECT_TRUE(run.events[0].changes_servos);
  EXPECT_EQ(run.events[0].servo_off.to_ulong(), 0x8000u);
}

TEST(RunFlow, TheLastTwoSlidersOfWordNAreNoServoBits) {
  const PoseFlow flow = word_n_of({pose_block(2, std::vector<int>(64, 8), kNoBlock)});
  const flow::Run run = run_of(flow);
  EXPECT_TRUE(run.events.empty());
  EXPECT_EQ(slider_of(run, 63), (std::vector<int>{0, 4, 8}));
}

TEST(RunFlow, StopsWhereAnArrowLeadsNowhere) {
  const PoseFlow flow = v1r4_of({start_block(1), pose_block(2, {0}, 2), loop_block(1, kNoBlock)});
  EXPECT_EQ(run_of(flow).end, flow::End::NoArrow);
  EXPECT_EQ(noticed_by(flow),
            ":30:1: note[RUN005]: the flow stops at block 2, whose branch arrow leads nowhere\n");
  EXPECT_EQ(run_of(word_n_loop()).end, flow::End::EndBlock);
}

TEST(RunFlow, StopsAtTheLimitOfTime) {
  const PoseFlow flow = word_n_of({pose_block(10, {100}, 1), pose_block(10, {0}, 0)});
  flow::RunOptions options;
  options.max_ticks = 25;
  const flow::Run run = run_of(flow, options);
  EXPECT_EQ(run.num_ticks, 25u);
  EXPECT_EQ(run.sliders.size(), 26u);
  EXPECT_EQ(run.end, flow::End::MaxTicks);
  EXPECT_EQ(noticed_by(flow, options),
            ":10:1: warning[RUN006]: the flow is cut off in block 0 after 25 ticks, the limit\n");
  options.max_ticks = 80;
  EXPECT_EQ(run_of(word_n_loop(), options).end, flow::End::EndBlock);
  options.max_ticks = 0;
  EXPECT_EQ(run_of(flow, options).sliders.size(), 1u);
}

TEST(RunFlow, NoticesBlocksThatGoRoundWithoutAPose) {
  const PoseFlow around = v1r4_of({start_block(1), pose_block(2, {0}, 2), loop_block(3, 3),
                                   branch_block(64, Condition::Never, 0, 2, 4), end_block()});
  EXPECT_EQ(
      to_string(run_fault(around)),
      ":30:1: error[RUN003]: the flow goes round without a pose at block 2, tick 2, or through "
      "more than 100000 blocks at once");
  // A counter that wraps around comes back to where it was only after 65536 rounds.
  const PoseFlow counting = v1r4_of({start_block(1), constant_block(64, Arithmetic::Add, 1, 1)});
  EXPECT_EQ(run_fault(counting).code, "RUN003");
  // One that leaves is none.
  const PoseFlow leaving = v1r4_of({start_block(1), constant_block(64, Arithmetic::Add, 1, 2),
                                    branch_block(64, Condition::AtLeast, 1000, 1, 3), end_block()});
  EXPECT_EQ(run_of(leaving).variables[64], 1000);
  const PoseFlow own = v1r4_of({start_block(1), loop_block(1, 2), end_block()});
  EXPECT_EQ(path_of(run_of(own, loops(3))), (Path{0, 1, 1, 1, 1, 2}));
}

TEST(RunFlow, NeedsABeginning) {
  EXPECT_EQ(to_string(run_fault(v1r4_of({end_block()}))),
            "error[RUN004]: expected a start block, found none");
  EXPECT_EQ(run_fault(word_n_of({})).code, "RUN004");
}

TEST(RunFlow, LeavesTheFlowAsItIsAndIsTheSameAgain) {
  const PoseFlow flow = v1r4_loop();
  const flow::Run first = run_of(flow, loops(2));
  const flow::Run second = run_of(flow, loops(2));
  EXPECT_EQ(flow, v1r4_loop());
  EXPECT_EQ(first.sliders, second.sliders);
}

TEST(RunFlow, TakesBasePoseAndJumpsFromAProject) {
  RobotProject project;
  project.sliders.resize(3);
  project.sliders[2].jumps = true;
  project.base_poses = {{"stand", {1, 2, 3}, {}}};
  const flow::RunOptions options = flow::run_options_of(project);
  EXPECT_EQ(options.base_pose, (std::vector<std::int16_t>{1, 2, 3}));
  EXPECT_EQ(options.jumps, (std::vector<bool>{false, false, true}));
}

}  // namespace
}  // namespace kinefile::test
