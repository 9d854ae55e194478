// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "kinefile/operation.hpp"
#include "support/flows.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

PoseFlow straight() {
  return v1r4_of({start_block(1), pose_block(10, {100, -200, 7}, 2),
                  pose_block(20, {300, 50, 8}, 3), pose_block(30, {-1000, 0, 9}, 4), end_block()});
}

template <class Value>
Value made(const Result<Value>& result) {
  EXPECT_TRUE(result) << result.error().message;
  return result ? *result : Value{};
}

template <class Value>
std::string refusal_of(const Result<Value>& result) {
  EXPECT_FALSE(result);
  return result ? "" : to_string(result.error());
}

std::vector<int> values_of(const Block& block) {
  std::vector<int> values;
  for (const SliderWord& word : pose_of(block).words) values.push_back(word.value);
  return values;
}

std::vector<int> ticks_of(const PoseFlow& flow) {
  std::vector<int> ticks;
  for (const Block& block : flow.blocks) {
    if (std::holds_alternative<PoseBlock>(block.body)) ticks.push_back(pose_of(block).ticks);
  }
  return ticks;
}

TEST(FlowEdit, AMirrorSwapsPairsWithTheirSign) {
  PoseFlow flow = straight();
  pose_of(flow.blocks[1]).servo_off[1] = true;
  pose_of(flow.blocks[1]).words[1].is_enabled = false;
  Diagnostics diagnostics;
  const std::vector<flow::MirrorPair> pairs = {{0, 1, -1}, {2, 2, -1}};
  const PoseFlow mirrored = made(flow::mirror(flow, pairs, diagnostics));
  EXPECT_EQ(values_of(mirrored.blocks[1]), (std::vector<int>{200, -100, -7}));
  EXPECT_FALSE(pose_of(mirrored.blocks[1]).words[0].is_enabled);
  EXPECT_TRUE(pose_of(mirrored.blocks[1]).words[1].is_enabled);
  EXPECT_TRUE(pose_of(mirrored.blocks[1]).servo_off[0]);
  EXPECT_FALSE(pose_of(mirrored.blocks[1]).servo_off[1]);
  EXPECT_EQ(made(flow::mirror(mirrored, pairs, diagnostics)), flow);
  EXPECT_EQ(values_of(made(flow::mirror(flow, {{0, 1, 1}}, diagnostics)).blocks[2]),
            (std::vector<int>{50, 300, 8}));
  EXPECT_EQ(text_of(diagnostics), "");
}

TEST(FlowEdit, AMirrorKeepsToSixteenBits) {
  const PoseFlow flow = v1r4_of({start_block(1), pose_block(1, {-32768, 5}, 2), end_block()});
  Diagnostics diagnostics;
  const PoseFlow mirrored = made(flow::mirror(flow, {{0, 1, -1}}, diagnostics));
  EXPECT_EQ(values_of(mirrored.blocks[1]), (std::vector<int>{-5, 32767}));
  EXPECT_EQ(text_of(diagnostics),
            "note[FLW013]: -32768 becomes 32767 in pose block 1, slider 0 or 1\n");
}

TEST(FlowEdit, AMirrorTellsOfSlidersThatAreVariables) {
  const PoseFlow flow = v1r4_of({start_block(1), pose_block(1, {1, 5}, 2),
                                 variable_block(64, Arithmetic::Assign, 1, 3),
                                 branch_block(64, Condition::Equal, 0, 4, 4), end_block()});
  Diagnostics diagnostics;
  made(flow::mirror(flow, {{0, 1, -1}}, diagnostics));
  EXPECT_EQ(text_of(diagnostics),
            "warning[FLW012]: block 2 uses slider 1 as a variable, which is not mirrored\n");
}

TEST(FlowEdit, AMirrorRefusesPairsThatAreNone) {
  Diagnostics diagnostics;
  EXPECT_EQ(refusal_of(flow::mirror(straight(), {{0, 3, -1}}, diagnostics)),
            "error[FLW002]: expected a slider below 3, found 3");
  EXPECT_EQ(refusal_of(flow::mirror(straight(), {{0, 1, -1}, {1, 2, -1}}, diagnostics)),
            "error[FLW002]: slider 1 is in two pairs");
  EXPECT_EQ(refusal_of(flow::mirror(straight(), {{0, 1, 2}}, diagnostics)),
            "error[FLW002]: expected a sign of 1 or -1, found 2");
}

TEST(FlowEdit, TakesPairsFromAProject) {
  RobotProject project;
  project.sliders.resize(6);
  const auto set_pair = [&project](std::size_t slider, PairKind kind, int partner) {
    project.sliders[slider].pair = kind;
    project.sliders[slider].partner = partner;
  };
  set_pair(0, PairKind::Left, 2);
  set_pair(2, PairKind::Right, 0);
  set_pair(3, PairKind::Centre, 0);
  set_pair(4, PairKind::Left, 5);
  set_pair(5, PairKind::Right, 40);
  const auto pairs = flow::mirror_pairs_of(project, 5);  // 5 is no slider of the flow
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].slider, 0u);
  EXPECT_EQ(pairs[0].partner, 2u);
  EXPECT_EQ(pairs[0].sign, -1);
  EXPECT_EQ(pairs[1].slider, 3u);
  EXPECT_EQ(pairs[1].partner, 3u);
}

/// A robot with pairs 0:1 and 2:3, slider 4 on its centre line and 5 on neither side.
RobotProject paired_robot(const std::vector<std::int16_t>& home = {}) {
  RobotProject project;
  project.sliders.resize(6);
  for (std::size_t s = 0; s < 4; ++s) {
    project.sliders[s].pair = s % 2 == 0 ? PairKind::Left : PairKind::Right;
    project.sliders[s].partner = static_cast<int>(s ^ 1);
  }
  project.sliders[4].pair = PairKind::Centre;
  if (!home.empty()) project.base_poses.push_back({"home", home, {}});
  return project;
}

/// What the poses of a flow show of the pair 0:1, by block: "alike 1, opposite 2, clear".
std::string evidence_of(const std::vector<std::vector<int>>& poses,
                        const std::vector<std::int16_t>& home = {}) {
  std::vector<Block> blocks = {start_block(1)};
  for (const std::vector<int>& words : poses) {
    blocks.push_back(pose_block(1, words, static_cast<int>(blocks.size()) + 1));
  }
  blocks.push_back(end_block());
  const PoseFlow flow = v1r4_of(blocks);
  const RobotProject project = paired_robot(home);
  const auto evidence =
      flow::sign_evidence(flow, project, flow::mirror_pairs_of(project, flow.num_sliders))[0];
  std::string text;
  if (evidence.alike_block) text += "alike " + std::to_string(*evidence.alike_block) + " ";
  if (evidence.opposite_block) text += "opposite " + std::to_string(*evidence.opposite_block) + " ";
  return text + (evidence.is_clear ? "clear" : "unclear");
}

TEST(FlowEdit, SymmetricPosesShowTheSignsOfPairs) {
  EXPECT_EQ(evidence_of({{2000, 2000, 0, 0, 0, 9000}}), "alike 1 clear");
  EXPECT_EQ(evidence_of({{2000, -2000, 0, 0, 0, 0}}), "opposite 1 clear");
  EXPECT_EQ(evidence_of({{0, 0, 0, 0, 0, 0}, {-5000, -4900, -3000, 3000, 0, 0}}), "alike 2 clear");
  EXPECT_EQ(evidence_of({{2000, 2000, 0, 0, 0, 0}, {3000, -3000, 0, 0, 0, 0}}),
            "alike 1 opposite 2 clear");
}

TEST(FlowEdit, PosesOfTwoSizesShowTheSignsOfPairs) {
  EXPECT_EQ(evidence_of({{2000, 2000, 8000, 0, 0, 0}, {-3000, -3000, 8000, 0, 0, 0}}),
            "alike 1 clear");
  EXPECT_EQ(evidence_of({{2000, 2000, 8000, 0, 0, 0}, {-2000, -2000, 0, -8000, 0, 0}}),
            "alike 1 unclear")
      << "two steps";
  EXPECT_EQ(evidence_of({{2000, 2000, 8000, 0, 0, 0}, {500, 500, 8000, 0, 0, 0}}),
            "alike 1 unclear");
}

TEST(FlowEdit, OtherPosesDoNotShowSignsClearly) {
  EXPECT_EQ(evidence_of({{2000, 2000, 8000, 0, 0, 0}}), "alike 1 unclear") << "one arm is raised";
  EXPECT_EQ(evidence_of({{2000, 2000, 0, 0, 4000, 0}}), "alike 1 unclear") << "the head is turned";
  EXPECT_EQ(evidence_of({{2000, 1500, 0, 0, 0, 0}}), "unclear") << "not of one size";
  EXPECT_EQ(evidence_of({{900, 900, 0, 0, 0, 0}}), "unclear") << "within a 64th of the range";
}

TEST(FlowEdit, SignsAreShownByTheWayFromTheBasePose) {
  EXPECT_EQ(evidence_of({{2300, 1750, 0, 0, 0, 0}}, {300, -250, 0, 0, 0, 0}), "alike 1 clear");
  EXPECT_EQ(evidence_of({{2000, 2000, 0, 0, 0, 0}}, {0, 4000, 0, 0, 0, 0}), "opposite 1 clear");
  EXPECT_EQ(evidence_of({{5000, 5000, 0, 0, 0, 0}}, {5000, 5000, 0, 0, 0, 0}), "unclear");
}

TEST(FlowEdit, DisabledSlidersShowNothing) {
  PoseFlow flow =
      v1r4_of({start_block(1), pose_block(1, {2000, 2000, 0, 0, 0, 0}, 2), end_block()});
  pose_of(flow.blocks[1]).words[1].is_enabled = false;
  const RobotProject project = paired_robot();
  const auto evidence = flow::sign_evidence(flow, project, flow::mirror_pairs_of(project, 6));
  ASSERT_EQ(evidence.size(), 3u);
  for (const flow::SignEvidence& one : evidence) {
    EXPECT_FALSE(one.alike_block || one.opposite_block || one.is_clear);
  }
}

/// A flow that `mirror` changed with a robot's project, and what was reported.
std::pair<std::string, std::vector<int>> mirrored_by_project(const std::string& word,
                                                             std::vector<Block> blocks) {
  Document document{v1r4_of(std::move(blocks)), "robovie", {}};
  const auto operation = parse_operation(word);
  EXPECT_TRUE(operation);
  OperationContext context;
  context.project = std::make_shared<const RobotProject>(paired_robot());
  Diagnostics diagnostics;
  const auto done = apply({&*operation, 1}, document, context, diagnostics);
  const std::string text = done ? text_of(diagnostics) : to_string(done.error()) + "\n";
  return {text, values_of(std::get<PoseFlow>(document.content).blocks[1])};
}

TEST(FlowEdit, AMirrorTakesTheSignsThatWordsShowUnlessTheyAreGiven) {
  const std::vector<Block> blocks = {start_block(1), pose_block(1, {2000, 2000, 30, 20, 7, 5}, 2),
                                     end_block()};
  const auto [text, values] = mirrored_by_project("mirror", blocks);
  EXPECT_EQ(text,
            "note[FLW017]: the project does not say whether a pair changes its sign; the words "
            "of poses show it: mirror=0:1:1\n");
  EXPECT_EQ(values, (std::vector<int>{2000, 2000, -20, -30, -7, 5}));
  const auto [told, given] = mirrored_by_project("mirror=0:1:-1", blocks);
  EXPECT_EQ(told, "");
  EXPECT_EQ(given, (std::vector<int>{-2000, -2000, -20, -30, -7, 5}));
}

TEST(FlowEdit, AMirrorKeepsTheDefaultInDoubt) {
  const auto [text, values] = mirrored_by_project(
      "mirror", {start_block(1), pose_block(1, {2000, 2000, 9000, 20, 7, 5}, 2), end_block()});
  EXPECT_EQ(
      text,
      "note[FLW019]: neither the project nor the poses say whether a pair changes its sign; these "
      "are taken to: mirror=2:3:-1\n"
      "warning[FLW015]: the project does not say whether a pair changes its sign; some are "
      "taken to, though the words of both sides are alike in one pose, which is not symmetric: "
      "mirror=0:1:1 keeps their sign\n");
  EXPECT_EQ(values, (std::vector<int>{-2000, -2000, -20, -9000, -7, 5}));
}

TEST(FlowEdit, AMirrorRefusesSignsThatContradictEachOther) {
  const std::vector<Block> blocks = {
      start_block(1), pose_block(1, {2000, 2000, 3000, 3000, 0, 0}, 2),
      pose_block(1, {3000, -3000, -2000, 2000, 0, 0}, 3), end_block()};
  EXPECT_EQ(mirrored_by_project("mirror", blocks).first,
            "error[FLW018]: mirror: the project does not say whether a pair changes its sign, and "
            "the words contradict each other: sliders 0 and 1 are alike in block 1 and opposite in "
            "block 2; sliders 2 and 3 are alike in block 1 and opposite in block 2; "
            "mirror=A:B:SIGN says it\n");
  const auto [text, values] = mirrored_by_project("mirror=0:1:1,2:3:-1", blocks);
  EXPECT_EQ(text, "");
  EXPECT_EQ(values, (std::vector<int>{2000, 2000, -3000, -3000, 0, 0}));
}

TEST(FlowEdit, AReverseKeepsTheTimesBetweenPoses) {
  PoseFlow flow = straight();
  flow.blocks[3].name = "last";
  pose_of(flow.blocks[2]).servo_off[4] = true;  // on the way from the first to the second
  const PoseFlow reversed = made(flow::reverse(flow));
  EXPECT_EQ(ticks_of(reversed), (std::vector<int>{10, 30, 20}));
  EXPECT_EQ(values_of(reversed.blocks[1]), (std::vector<int>{-1000, 0, 9}));
  EXPECT_EQ(values_of(reversed.blocks[2]), (std::vector<int>{300, 50, 8}));
  EXPECT_EQ(values_of(reversed.blocks[3]), (std::vector<int>{100, -200, 7}));
  EXPECT_EQ(reversed.blocks[1].name, "last");
  EXPECT_TRUE(pose_of(reversed.blocks[3]).servo_off[4]);
  EXPECT_EQ(made(flow::reverse(reversed)), flow);
  // After the first pose, what is seen runs backwards.
  const auto forth = slider_of(run_of(flow), 1);
  const auto back = slider_of(run_of(reversed), 1);
  ASSERT_EQ(back.size(), forth.size());
  for (std::size_t tick = 0; tick <= 50; ++tick) {
    EXPECT_NEAR(back[10 + tick], forth[60 - tick], 1) << tick;  // rounded towards the other end
  }
}

TEST(FlowEdit, AReverseNeedsAStraightFlow) {
  EXPECT_EQ(refusal_of(flow::reverse(v1r4_loop())),
            "error[FLW003]: expected poses that go straight on, found that block 4 loops, branches "
            "or computes");
  EXPECT_EQ(refusal_of(flow::reverse(word_n_loop())),
            "error[FLW003]: expected poses that go straight on, found that block 1 has a break");
  EXPECT_EQ(refusal_of(flow::reverse(word_n_of({pose_block(1, {0}, 1), pose_block(1, {0}, 0)}))),
            "error[FLW003]: expected poses that go straight on, found that block 0 is come to "
            "again");
}

TEST(FlowEdit, ASpeedDividesTimes) {
  Diagnostics diagnostics;
  EXPECT_EQ(ticks_of(made(flow::speed(straight(), 2, diagnostics))), (std::vector<int>{5, 10, 15}));
  EXPECT_EQ(ticks_of(made(flow::speed(straight(), 0.5, diagnostics))),
            (std::vector<int>{20, 40, 60}));
  EXPECT_EQ(made(flow::speed(v1r4_loop(), 1, diagnostics)), v1r4_loop());
  EXPECT_EQ(text_of(diagnostics), "");
  EXPECT_EQ(ticks_of(made(flow::speed(straight(), 25, diagnostics))), (std::vector<int>{1, 1, 1}));
  EXPECT_EQ(text_of(diagnostics),
            "note[FLW016]: block 1 would take 0.4 ticks and takes one\n"
            "note[FLW016]: block 2 would take 0.8 ticks and takes one\n");
}

TEST(FlowEdit, ASlowPoseIsPartedOnItsLine) {
  PoseFlow flow = word_n_of({pose_block(50, {0, 5}, 1), pose_block(100, {1000, -995}, 0, 2),
                             pose_block(10, {0, 0}, kNoBlock)});
  pose_of(flow.blocks[1]).sound = "drum.wav";
  Diagnostics diagnostics;
  const PoseFlow slow = made(flow::speed(flow, 0.25, diagnostics));
  EXPECT_EQ(text_of(diagnostics), "");
  EXPECT_EQ(ticks_of(slow), (std::vector<int>{200, 200, 200, 40}));
  EXPECT_EQ(values_of(slow.blocks[1]), (std::vector<int>{500, -495}));
  EXPECT_EQ(values_of(slow.blocks[2]), (std::vector<int>{1000, -995}));
  EXPECT_EQ(slow.blocks[0].normal, 1);
  EXPECT_EQ(slow.blocks[1].normal, 2);
  EXPECT_EQ(slow.blocks[1].branch, kNoBlock);
  EXPECT_EQ(slow.blocks[2].normal, 0);
  EXPECT_EQ(slow.blocks[2].branch, 3);
  EXPECT_EQ(pose_of(slow.blocks[1]).sound, "drum.wav");
  EXPECT_EQ(pose_of(slow.blocks[2]).sound, "");
  EXPECT_EQ(run_of(slow).num_ticks, 4 * run_of(flow).num_ticks);
}

TEST(FlowEdit, ASlowPoseFromManyPlacesIsHeld) {
  const PoseFlow flow = v1r4_of({start_block(1), pose_block(200, {900}, 2), end_block()});
  Diagnostics diagnostics;
  const PoseFlow slow = made(flow::speed(flow, 0.5, diagnostics));
  EXPECT_EQ(ticks_of(slow), (std::vector<int>{200, 200}));
  EXPECT_EQ(values_of(slow.blocks[1]), (std::vector<int>{900}));
  EXPECT_EQ(slow.blocks[0].normal, 1);
  EXPECT_EQ(slow.blocks[2].normal, 3);
  EXPECT_EQ(text_of(diagnostics),
            "warning[FLW014]: block 1 takes 400 ticks, and where the robot comes from is not said; "
            "it is reached after 200 and held\n");
}

TEST(FlowEdit, ASpeedIsAboveZeroAndNotTooSlow) {
  Diagnostics diagnostics;
  EXPECT_EQ(refusal_of(flow::speed(straight(), 0, diagnostics)),
            "error[FLW004]: expected a factor above 0, found 0");
  EXPECT_EQ(refusal_of(flow::speed(straight(), 1e-9, diagnostics)),
            "error[FLW004]: the flow would have 2.51e+08 blocks, more than 100000");
}

TEST(FlowEdit, AnOffsetMovesWordsThatAreEnabled) {
  PoseFlow flow = straight();
  pose_of(flow.blocks[2]).words[0].is_enabled = false;
  const PoseFlow moved = made(flow::offset(flow, 0, -30));
  EXPECT_EQ(values_of(moved.blocks[1]), (std::vector<int>{70, -200, 7}));
  EXPECT_EQ(values_of(moved.blocks[2]), (std::vector<int>{300, 50, 8}));
  EXPECT_EQ(refusal_of(flow::offset(flow, 3, 1)),
            "error[FLW005]: expected a slider below 3, found 3");
  EXPECT_EQ(refusal_of(flow::offset(flow, 0, -32000)),
            "error[FLW005]: slider 0 would be -33000 in block 3, and words go from -32768 to "
            "32767");
}

TEST(FlowEdit, AMergeTakesSlidersPoseByPose) {
  const PoseFlow other = word_n_of(
      {pose_block(1, {1, 2}, 1), pose_block(1, {3, 4}, 2), pose_block(1, {5, 6}, kNoBlock)});
  const PoseFlow merged = made(flow::merge(straight(), other, {1}));
  EXPECT_EQ(values_of(merged.blocks[1]), (std::vector<int>{100, 2, 7}));
  EXPECT_EQ(values_of(merged.blocks[3]), (std::vector<int>{-1000, 6, 9}));
  EXPECT_EQ(ticks_of(merged), ticks_of(straight()));
  EXPECT_EQ(refusal_of(flow::merge(straight(), other, {2})),
            "error[FLW006]: expected sliders of both flows, below 2, found 2");
  EXPECT_EQ(refusal_of(flow::merge(straight(), v1r4_loop(), {0})),
            "error[FLW006]: expected flows with as many poses, found 3 and 4");
}

TEST(FlowEdit, InsertsPosesOnTheNormalWay) {
  PoseFlow flow = v1r4_loop();
  const PoseFlow other = word_n_of({pose_block(1, {1}, 1), pose_block(2, {2}, kNoBlock)});
  const PoseFlow longer = made(flow::insert(flow, 4, other));
  ASSERT_EQ(longer.blocks.size(), 9u);
  EXPECT_EQ(longer.blocks[4].normal, 5);
  EXPECT_EQ(longer.blocks[4].branch, 7);  // what was 5
  EXPECT_EQ(values_of(longer.blocks[5]), (std::vector<int>{1, 0}));
  EXPECT_FALSE(pose_of(longer.blocks[5]).words[1].is_enabled);
  EXPECT_EQ(longer.blocks[5].normal, 6);
  EXPECT_EQ(longer.blocks[6].normal, 2);
  EXPECT_EQ(longer.blocks[7].normal, 8);
  EXPECT_EQ(longer.blocks[5].y, flow.blocks[4].y + 54);
  EXPECT_EQ(longer.blocks[7].y, flow.blocks[5].y + 108);
  flow::RunOptions options;
  options.num_loops = 1;
  EXPECT_EQ(run_of(longer, options).num_ticks, 113u);
}

TEST(FlowEdit, InsertsAtTheEndOfWordN) {
  const PoseFlow other =
      v1r4_of({start_block(1), pose_block(4, {1, 2}, 2), pose_block(5, {3, 4}, 3), end_block()});
  const PoseFlow longer = made(flow::insert(word_n_loop(), 3, other));
  ASSERT_EQ(longer.blocks.size(), 6u);
  EXPECT_EQ(longer.blocks[3].normal, 4);
  EXPECT_EQ(longer.blocks[5].normal, kNoBlock);
  EXPECT_EQ(run_of(longer).num_ticks, 89u);
}

TEST(FlowEdit, RefusesToInsertWhatDoesNotFit) {
  EXPECT_EQ(refusal_of(flow::insert(straight(), 9, straight())),
            "error[FLW007]: expected a block below 5, found 9");
  EXPECT_EQ(refusal_of(flow::insert(straight(), 4, straight())),
            "error[FLW007]: block 4 is an end, and nothing follows an end");
  EXPECT_EQ(refusal_of(flow::insert(straight(), 1, v1r4_loop())),
            "error[FLW003]: expected poses that go straight on, found that block 4 loops, branches "
            "or computes");
  EXPECT_EQ(refusal_of(flow::insert(v1r4_loop(), 1, straight())),
            "error[FLW006]: expected poses of 2 sliders to insert, found one that sets slider 2");
  PoseFlow limp = v1r4_of({start_block(1), pose_block(1, {1}, kNoBlock)});
  pose_of(limp.blocks[1]).servo_off[0] = true;
  EXPECT_EQ(refusal_of(flow::insert(word_n_loop(), 1, limp)),
            "error[FLW001]: WORD_N cannot say it: an inserted pose switches servos off");
}

TEST(FlowEdit, TakesABlockOut) {
  const PoseFlow shorter = made(flow::erase(v1r4_loop(), 2));
  ASSERT_EQ(shorter.blocks.size(), 6u);
  EXPECT_EQ(shorter.blocks[1].normal, 2);
  EXPECT_EQ(shorter.blocks[3].normal, 2);  // the loop goes to what followed
  EXPECT_EQ(shorter.blocks[3].branch, 4);
  EXPECT_EQ(run_of(shorter).num_ticks, 80u);
  EXPECT_EQ(refusal_of(flow::erase(v1r4_loop(), 0)),
            "error[FLW007]: block 0 is the start, without which nothing runs");
  EXPECT_EQ(refusal_of(flow::erase(v1r4_loop(), 7)),
            "error[FLW007]: expected a block below 7, found 7");
  EXPECT_EQ(refusal_of(flow::erase(word_n_loop(), 2)),
            "error[FLW007]: without block 2, pose 1 would lead to itself, which WORD_N does not "
            "allow");
  EXPECT_EQ(made(flow::erase(v1r4_loop(), 6)).blocks[5].normal, kNoBlock);
}

TEST(FlowEdit, WhatIsInsertedCanBeTakenOutAgain) {
  const PoseFlow other = word_n_of({pose_block(1, {1, 2}, kNoBlock)});
  const PoseFlow longer = made(flow::insert(word_n_loop(), 1, other));
  EXPECT_EQ(made(flow::erase(longer, 2)), word_n_loop());
}

}  // namespace
}  // namespace kinefile::test
