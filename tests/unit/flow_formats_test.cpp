// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "support/flows.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

PoseFlow converted(const PoseFlow& flow, FlowFormat format, Diagnostics& diagnostics) {
  const auto made = flow::in_format(flow, format, diagnostics);
  EXPECT_TRUE(made) << made.error().message;
  return made ? *made : PoseFlow{};
}

PoseFlow converted(const PoseFlow& flow, FlowFormat format) {
  Diagnostics diagnostics;
  return converted(flow, format, diagnostics);
}

std::string refusal_of(const PoseFlow& flow) {
  Diagnostics diagnostics;
  const auto made = flow::in_format(flow, FlowFormat::WordN, diagnostics);
  EXPECT_FALSE(made);
  if (made) return {};
  EXPECT_EQ(made.error().kind, ErrorKind::DataLoss);
  return to_string(made.error());
}

/// Expects that two flows do the same, for buttons held in several ways.
void expect_same_runs(const PoseFlow& a, const PoseFlow& b) {
  for (const std::uint64_t hold : {0u, 45u, 55u, 65u, 75u, 200u}) {
    flow::RunOptions options;
    options.hold_ticks = hold;
    options.max_ticks = 1000;
    EXPECT_EQ(run_of(a, options).sliders, run_of(b, options).sliders) << hold;
  }
}

TEST(FlowFormats, WordNBecomesBlocks) {
  Diagnostics diagnostics;
  const PoseFlow flow = converted(word_n_loop(), FlowFormat::V1R4, diagnostics);
  EXPECT_EQ(text_of(diagnostics), "");
  EXPECT_EQ(flow.format, FlowFormat::V1R4);
  ASSERT_EQ(flow.blocks.size(), 8u);  // start, 0, 1, loop, 2, loop, 3, end
  EXPECT_EQ(flow.blocks[0].normal, 1);
  EXPECT_EQ(flow.blocks[1].normal, 2);
  EXPECT_EQ(flow.blocks[2].normal, 3);
  EXPECT_EQ(flow.blocks[2].branch, kNoBlock);
  EXPECT_EQ(body_name(flow.blocks[3]), "loop");
  EXPECT_EQ(flow.blocks[3].normal, 4);
  EXPECT_EQ(flow.blocks[3].branch, 6);
  EXPECT_EQ(flow.blocks[5].normal, 2);
  EXPECT_EQ(flow.blocks[5].branch, 6);
  EXPECT_EQ(flow.blocks[6].name, "POSE 3");
  EXPECT_EQ(flow.blocks[6].normal, 7);
  EXPECT_EQ(body_name(flow.blocks[7]), "end");
  EXPECT_EQ(flow.blocks[0].y, 10);
  EXPECT_EQ(flow.blocks[1].y, 46);
  EXPECT_EQ(flow.blocks[7].y, 46 + 6 * 54);
}

TEST(FlowFormats, WhatIsConvertedRunsTheSame) {
  expect_same_runs(word_n_loop(), converted(word_n_loop(), FlowFormat::V1R4));
  expect_same_runs(v1r4_loop(), converted(v1r4_loop(), FlowFormat::WordN));
  for (const std::uint64_t count : {0u, 1u, 3u}) {
    flow::RunOptions options;
    options.num_loops = count;
    EXPECT_EQ(run_of(converted(word_n_loop(), FlowFormat::V1R4), options).num_ticks,
              80 + 20 * count);
    EXPECT_EQ(run_of(converted(v1r4_loop(), FlowFormat::WordN), options).num_ticks,
              90 + 20 * count);
  }
}

TEST(FlowFormats, ThereAndBackIsTheSame) {
  Diagnostics diagnostics;
  const PoseFlow there = converted(word_n_loop(), FlowFormat::V1R4, diagnostics);
  EXPECT_EQ(converted(there, FlowFormat::WordN, diagnostics), word_n_loop());
  const PoseFlow other = converted(v1r4_loop(), FlowFormat::WordN, diagnostics);
  EXPECT_EQ(converted(other, FlowFormat::V1R4, diagnostics), v1r4_loop());
  EXPECT_EQ(text_of(diagnostics), "");
  EXPECT_EQ(converted(v1r4_loop(), FlowFormat::V1R4), v1r4_loop());
}

TEST(FlowFormats, TellsWhatIsLost) {
  PoseFlow flow = v1r4_loop();
  flow.blocks[1].name = "bow";
  Diagnostics diagnostics;
  converted(flow, FlowFormat::WordN, diagnostics);
  EXPECT_EQ(text_of(diagnostics),
            "warning[FLW011]: WORD_N has no names and places of blocks; they are left out\n");
}

TEST(FlowFormats, CutsTheTwoSlidersThatBecameServoBits) {
  PoseFlow flow = word_n_of({pose_block(5, std::vector<int>(64, 3), kNoBlock)});
  Diagnostics diagnostics;
  EXPECT_EQ(converted(flow, FlowFormat::V1R4, diagnostics).num_sliders, 62u);
  EXPECT_EQ(text_of(diagnostics),
            "warning[FLW008]: V1R4 has sliders 0 to 61; the words of sliders 62 and 63 are left "
            "out\n");
  auto& words = pose_of(flow.blocks[0]).words;
  words[62].is_enabled = words[63].is_enabled = false;
  Diagnostics none;
  EXPECT_EQ(pose_of(converted(flow, FlowFormat::V1R4, none).blocks[1]).words.size(), 62u);
  EXPECT_EQ(text_of(none), "");
}

TEST(FlowFormats, BeginsWithThePoseBehindTheStart) {
  const PoseFlow flow =
      v1r4_of({end_block(), pose_block(7, {7}, 0), pose_block(5, {5}, 1), start_block(2)});
  const PoseFlow made = converted(flow, FlowFormat::WordN);
  ASSERT_EQ(made.blocks.size(), 2u);
  EXPECT_EQ(pose_of(made.blocks[0]).ticks, 5);
  EXPECT_EQ(made.blocks[0].normal, 1);
  EXPECT_EQ(made.blocks[1].normal, kNoBlock);
}

TEST(FlowFormats, PassesThroughStartBlocksOnTheWay) {
  const PoseFlow flow =
      v1r4_of({start_block(2), start_block(0), pose_block(9, {9}, 3), pose_block(8, {8}, 1)});
  const PoseFlow made = converted(flow, FlowFormat::WordN);
  ASSERT_EQ(made.blocks.size(), 2u);
  EXPECT_EQ(made.blocks[1].normal, 0);
  expect_same_runs(flow, made);
}

TEST(FlowFormats, WritesAPoseThatLeadsToItselfTwice) {
  const PoseFlow flow = v1r4_of({start_block(1), pose_block(10, {100}, 2), loop_block(1, 3),
                                 pose_block(20, {0}, 4), end_block()});
  Diagnostics diagnostics;
  const PoseFlow made = converted(flow, FlowFormat::WordN, diagnostics);
  ASSERT_EQ(made.blocks.size(), 3u);
  EXPECT_EQ(made.blocks[0].normal, 2);
  EXPECT_EQ(made.blocks[2].normal, 0);
  EXPECT_EQ(made.blocks[2].branch, 1);
  EXPECT_EQ(codes_of(diagnostics), (std::vector<std::string>{"FLW010", "FLW011"}));
  expect_same_runs(flow, made);
}

TEST(FlowFormats, RefusesWhatWordNCannotSay) {
  EXPECT_EQ(refusal_of(v1r4_counter()),
            ":20:1: error[FLW001]: WORD_N cannot say it: block 1 computes");
  EXPECT_EQ(refusal_of(v1r4_of({start_block(1), branch_block(64, Condition::Always, 0, 2, 2),
                                pose_block(1, {0}, 3), end_block()})),
            ":20:1: error[FLW001]: WORD_N cannot say it: block 1 branches");
  PoseFlow limp = v1r4_loop();
  pose_of(limp.blocks[3]).servo_off[2] = true;
  EXPECT_EQ(refusal_of(limp),
            ":40:1: error[FLW001]: WORD_N cannot say it: block 3 switches servos off");
  EXPECT_EQ(
      refusal_of(v1r4_of({start_block(1), loop_block(2, 3), pose_block(1, {0}, 3), end_block()})),
      ":10:1: error[FLW001]: WORD_N cannot say it: block 0 is not followed by a pose, and a "
      "flow begins with one");
  EXPECT_EQ(refusal_of(v1r4_of({start_block(1), pose_block(1, {0}, 2), loop_block(1, 3),
                                loop_block(1, 4), end_block()})),
            ":30:1: error[FLW001]: WORD_N cannot say it: block 2 is a loop that leads to a loop, "
            "with no pose between");
  EXPECT_EQ(
      refusal_of(v1r4_of({start_block(1), pose_block(1, {0}, 2), loop_block(1, 3), end_block()})),
      ":30:1: error[FLW001]: WORD_N cannot say it: block 2 is a loop whose branch leads to "
      "the end, and a break leads to a pose; put one before the end");
  EXPECT_EQ(refusal_of(v1r4_of({})), "error[FLW001]: WORD_N cannot say it: no blocks");
}

TEST(FlowFormats, TellsOfLoopsThatNothingLeadsTo) {
  PoseFlow flow = v1r4_of({start_block(1), pose_block(1, {0}, 2), end_block(), loop_block(1, 2)});
  Diagnostics diagnostics;
  EXPECT_EQ(converted(flow, FlowFormat::WordN, diagnostics).blocks.size(), 1u);
  EXPECT_EQ(diagnostics.items()[0].message, "loop block 3 is left out: no arrow leads to it");
}

}  // namespace
}  // namespace kinefile::test
