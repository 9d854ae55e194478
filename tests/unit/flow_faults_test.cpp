// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include "kinefile/pose_flow.hpp"

namespace kinefile::test {
namespace {

Block block(BlockBody body, int normal, int branch = kNoBlock) {
  Block made;
  made.body = std::move(body);
  made.normal = normal;
  made.branch = branch;
  return made;
}

using Faults = std::vector<std::pair<FlowFault, std::size_t>>;

Faults faults_of(FlowFormat format, std::vector<Block> blocks) {
  PoseFlow flow;
  flow.format = format;
  flow.blocks = std::move(blocks);
  Faults faults;
  for (const FlowFinding& finding : find_flow_faults(flow)) {
    faults.emplace_back(finding.fault, finding.block);
  }
  return faults;
}

Faults faults_of(std::vector<Block> blocks) {
  return faults_of(FlowFormat::V1R4, std::move(blocks));
}

const PoseBlock kPose;

TEST(ReachableBlocks, AreThoseThatAWayLeadsToFromTheFirst) {
  PoseFlow flow;
  flow.blocks = {block(kPose, 1), block(EndBlock{}, -1), block(StartBlock{}, 1), block(kPose, 2)};
  EXPECT_EQ(reachable_blocks(flow), (std::vector<bool>{false, true, true, false}));
  flow.blocks.erase(flow.blocks.begin() + 2);
  EXPECT_EQ(reachable_blocks(flow), (std::vector<bool>{false, false, false}));
  flow.format = FlowFormat::WordN;
  flow.blocks = {block(kPose, 1, 2), block(kPose, 0), block(kPose, -1)};
  EXPECT_EQ(reachable_blocks(flow), (std::vector<bool>{true, true, true}));
}

TEST(FlowFaults, AStraightFlowHasNone) {
  EXPECT_EQ(faults_of({block(StartBlock{}, 2), block(EndBlock{}, -1), block(kPose, 1)}), Faults{});
  EXPECT_EQ(faults_of({}), Faults{});
}

TEST(FlowFaults, BlocksThatNoWayLeadsTo) {
  // 3 and 4 lead to each other: told for each, and not as a circle as well.
  EXPECT_EQ(faults_of({block(StartBlock{}, 1), block(kPose, 2), block(EndBlock{}, -1),
                       block(kPose, 4), block(kPose, 3)}),
            (Faults{{FlowFault::Unreachable, 3}, {FlowFault::Unreachable, 4}}));
  // The branch of a pose is no way in V1R4, and one in WORD_N.
  EXPECT_EQ(faults_of(FlowFormat::WordN, {block(kPose, 1, 2), block(kPose, -1), block(kPose, -1)}),
            Faults{});
}

TEST(FlowFaults, WaysThatLeadNowhere) {
  EXPECT_EQ(
      faults_of(
          {block(StartBlock{}, 1), block(LoopBlock{}, 2), block(kPose, -1), block(EndBlock{}, -1)}),
      (Faults{{FlowFault::NoBranch, 1}, {FlowFault::DeadEnd, 2}, {FlowFault::Unreachable, 3}}));
  EXPECT_EQ(faults_of(FlowFormat::WordN, {block(kPose, -1)}), Faults{});
}

TEST(FlowFaults, CirclesThatNothingLeadsOutOf) {
  const Faults circle = {{FlowFault::EndlessCycle, 0}};
  EXPECT_EQ(faults_of(FlowFormat::WordN, {block(kPose, 1), block(kPose, 0)}), circle);
  EXPECT_EQ(faults_of(FlowFormat::WordN, {block(kPose, 1, 2), block(kPose, 0), block(kPose, -1)}),
            Faults{});
  // A loop whose both ways stay inside leads nowhere else.
  EXPECT_EQ(faults_of({block(StartBlock{}, 1), block(kPose, 2), block(LoopBlock{}, 1, 3),
                       block(kPose, 1)}),
            (Faults{{FlowFault::NoEnd, 0}, {FlowFault::EndlessCycle, 1}}));
}

TEST(FlowFaults, CirclesThatTakeNoTime) {
  // An endless one, one that a branch leads out of, and one block that leads to itself.
  EXPECT_EQ(faults_of({block(StartBlock{}, 1), block(ArithmeticBlock{}, 2),
                       block(ArithmeticBlock{}, 1), block(EndBlock{}, -1)}),
            (Faults{{FlowFault::CycleWithoutPose, 1}, {FlowFault::Unreachable, 3}}));
  EXPECT_EQ(faults_of({block(StartBlock{}, 1), block(BranchBlock{}, 2, 3),
                       block(ArithmeticBlock{}, 1), block(EndBlock{}, -1)}),
            (Faults{{FlowFault::CycleWithoutPose, 1}}));
  EXPECT_EQ(faults_of({block(StartBlock{}, 1), block(LoopBlock{}, 1, 2), block(EndBlock{}, -1)}),
            (Faults{{FlowFault::CycleWithoutPose, 1}}));
}

TEST(FlowFaults, AMillionBlocksTakeNoRecursion) {
  constexpr int kCount = 1'000'000;
  std::vector<Block> blocks;
  for (int b = 0; b < kCount; ++b) blocks.push_back(block(ArithmeticBlock{}, (b + 1) % kCount));
  blocks[0].body = StartBlock{};
  EXPECT_EQ(faults_of(std::move(blocks)),
            (Faults{{FlowFault::CycleWithoutPose, 0}, {FlowFault::NoEnd, 0}}));
}

}  // namespace
}  // namespace kinefile::test
