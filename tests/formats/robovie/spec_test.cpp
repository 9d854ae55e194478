// SPDX-License-Identifier: MIT
// The examples of the format's document, its dots completed with 0X0000; docs/formats/robovie.md
// explains them line by line.

#include "formats/robovie/robovie.hpp"

namespace kinefile::test {
namespace {

constexpr char kDrum[] = "RB2000音声ファイル\\drum(サイド1).wav";

PoseFlow read_example(const std::string& name) {
  const ReadText read = read_robovie(fixture("robovie/valid/" + name));
  EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"RBV048"});  // UTF-8 and LF
  return flow_of(read);
}

const PoseBlock& pose_at(const PoseFlow& flow, std::size_t block) {
  return std::get<PoseBlock>(flow.blocks.at(block).body);
}

TEST(RobovieDocument, TheListOfPosesIsReadAsItIsExplained) {
  const PoseFlow flow = read_example("drum.txt");
  EXPECT_EQ(flow.format, FlowFormat::WordN);
  EXPECT_EQ(flow.num_sliders, 64u);
  ASSERT_EQ(flow.blocks.size(), 4u);
  const int ticks[] = {40, 10, 10, 30};
  const std::pair<int, int> ways[] = {{1, -1}, {2, 3}, {1, 3}, {-1, -1}};
  for (std::size_t p = 0; p < 4; ++p) {
    const PoseBlock& pose = pose_at(flow, p);
    EXPECT_EQ(pose.ticks, ticks[p]);
    EXPECT_EQ(std::pair(flow.blocks[p].normal, flow.blocks[p].branch), ways[p]);
    EXPECT_EQ(pose.sound, kDrum);
    ASSERT_EQ(pose.words.size(), 64u);
    EXPECT_EQ(pose.words[0], (SliderWord{0, false}));
    EXPECT_EQ(pose.words[1],
              (SliderWord{static_cast<std::int16_t>(p < 3 ? 0x2b01 : 0x2652), true}));
    EXPECT_EQ(flow.blocks[p].line, p + 3);
  }
}

TEST(RobovieDocument, BlocksOfEveryKindAreReadAsTheyAreExplained) {
  const PoseFlow flow = read_example("all_blocks.txt");
  EXPECT_EQ(flow.format, FlowFormat::V1R4);
  EXPECT_EQ(flow.num_sliders, 62u);
  ASSERT_EQ(flow.blocks.size(), 8u);

  const Block& start = flow.blocks[0];
  EXPECT_EQ(body_name(start), "start");
  EXPECT_EQ(start.name, "");
  EXPECT_EQ(std::pair(start.x, start.y), std::pair(50, 10));
  EXPECT_EQ(std::pair(start.normal_turn, start.branch_turn), std::pair(6, 0));
  EXPECT_EQ(std::pair(start.normal, start.branch), std::pair(1, -1));

  const Block& end = flow.blocks[7];
  EXPECT_EQ(body_name(end), "end");
  EXPECT_EQ(end.name, " END ");
  EXPECT_EQ(std::pair(end.x, end.y), std::pair(92, 647));
  EXPECT_EQ(std::pair(end.normal_turn, end.branch_turn), std::pair(16, 46));

  EXPECT_EQ(flow.blocks[1].body, BlockBody(ArithmeticBlock{64, Arithmetic::Assign, false, 0}));
  EXPECT_EQ(flow.blocks[5].body, BlockBody(ArithmeticBlock{64, Arithmetic::Add, true, 65}));
  EXPECT_EQ(body_name(flow.blocks[4]), "loop");
  EXPECT_EQ(std::pair(flow.blocks[4].normal, flow.blocks[4].branch), std::pair(2, 5));
  EXPECT_EQ(flow.blocks[6].name, "□ [shift]");
  // 0x80 wanted, 0x80 looked at: -32640 = 0x8080 - 65536.
  EXPECT_EQ(flow.blocks[6].body, BlockBody(BranchBlock{241, Condition::BitsMatch, -32640}));

  EXPECT_EQ(pose_at(flow, 2).sound, kDrum);
  EXPECT_TRUE(pose_at(flow, 2).servo_off.none());
  // The leftmost digit is channel 0, and 1 takes its power away.
  EXPECT_TRUE(pose_at(flow, 3).servo_off.test(0));
  EXPECT_EQ(pose_at(flow, 3).servo_off.count(), 1u);
  EXPECT_EQ(pose_at(flow, 3).words[1],
            (SliderWord{static_cast<std::int16_t>(0xd4ff - 65536), true}));
}

TEST(RobovieDocument, EveryTruncationIsReadOrRefusedWithAPlace) {
  for (const std::string name : {"drum.txt", "all_blocks.txt"}) {
    const std::string whole = fixture("robovie/valid/" + name);
    const std::size_t num_blocks = read_example(name).blocks.size();
    for (std::size_t length = 0; length < whole.size(); ++length) {
      const ReadText read = read_robovie(whole.substr(0, length), {.encoding = "utf-8"});
      for (const Diagnostic& item : read.diagnostics.items()) EXPECT_GT(item.place.line, 0u);
      // Only the end of the last line may be missing.
      if (read.document) {
        EXPECT_EQ(length, whole.size() - 1) << name;
        EXPECT_EQ(flow_of(read).blocks.size(), num_blocks);
      }
    }
  }
}

}  // namespace
}  // namespace kinefile::test
