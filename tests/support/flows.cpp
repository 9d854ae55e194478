// SPDX-License-Identifier: MIT
#include "support/flows.hpp"

#include <gtest/gtest.h>

#include "flow/blocks.hpp"

namespace kinefile::test {
namespace {

Block block_of(BlockBody body, int normal, int branch) {
  Block block;
  block.body = std::move(body);
  block.normal = normal;
  block.branch = branch;
  return block;
}

PoseFlow flow_of(FlowFormat format, std::vector<Block> blocks) {
  PoseFlow flow;
  flow.format = format;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    blocks[b].line = 10 * (b + 1);
    const auto* pose = std::get_if<PoseBlock>(&blocks[b].body);
    if (pose != nullptr) flow.num_sliders = pose->words.size();
  }
  flow.blocks = std::move(blocks);
  return flow;
}

}  // namespace

Block start_block(int normal) { return block_of(StartBlock{}, normal, kNoBlock); }
Block end_block() { return block_of(EndBlock{}, kNoBlock, kNoBlock); }

Block pose_block(int ticks, const std::vector<int>& values, int normal, int branch) {
  PoseBlock pose;
  pose.ticks = ticks;
  for (const int value : values) pose.words.push_back({static_cast<std::int16_t>(value), true});
  return block_of(std::move(pose), normal, branch);
}

Block loop_block(int normal, int branch) { return block_of(LoopBlock{}, normal, branch); }

Block constant_block(int variable, Arithmetic operation, int constant, int normal) {
  return block_of(ArithmeticBlock{variable, operation, false, constant}, normal, kNoBlock);
}

Block variable_block(int variable, Arithmetic operation, int other, int normal) {
  return block_of(ArithmeticBlock{variable, operation, true, other}, normal, kNoBlock);
}

Block branch_block(int variable, Condition condition, int detail, int normal, int branch) {
  return block_of(BranchBlock{variable, condition, detail}, normal, branch);
}

PoseFlow v1r4_of(std::vector<Block> blocks) { return flow_of(FlowFormat::V1R4, std::move(blocks)); }
PoseFlow word_n_of(std::vector<Block> blocks) {
  return flow_of(FlowFormat::WordN, std::move(blocks));
}

PoseFlow word_n_loop() {
  return word_n_of({pose_block(40, {0x2b01, -0x2b01}, 1), pose_block(10, {0x2b01, -0x2400}, 2, 3),
                    pose_block(10, {0x2400, -0x2b01}, 1, 3),
                    pose_block(30, {0x2652, -0x2652}, kNoBlock)});
}

PoseFlow v1r4_loop() {
  PoseFlow flow =
      v1r4_of({start_block(1), pose_block(40, {0x2b01, -0x2b01}, 2),
               pose_block(10, {0x2b01, -0x2400}, 3), pose_block(10, {0x2400, -0x2b01}, 4),
               loop_block(2, 5), pose_block(30, {0x2652, -0x2652}, 6), end_block()});
  const char* const names[] = {"", "POSE 0", "POSE 1", "POSE 2", "LOOP", "POSE 3", "   END   "};
  for (std::size_t b = 0; b < flow.blocks.size(); ++b) {
    Block& block = flow.blocks[b];
    const int y =
        b == 0 ? flow::kStartRow : flow::kFirstRow + (static_cast<int>(b) - 1) * flow::kRowHeight;
    Block made = flow::new_block(block.body, names[b], y);
    made.normal = block.normal;
    made.branch = block.branch;
    made.line = block.line;
    block = made;
  }
  return flow;
}

PoseFlow v1r4_counter() {
  return v1r4_of({start_block(1), constant_block(64, Arithmetic::Assign, 0, 2),
                  pose_block(10, {0x2000}, 3), pose_block(10, {-0x2000}, 4),
                  constant_block(64, Arithmetic::Add, 1, 5),
                  branch_block(64, Condition::AtLeast, 3, 2, 6), end_block()});
}

PoseBlock& pose_of(Block& block) { return std::get<PoseBlock>(block.body); }
const PoseBlock& pose_of(const Block& block) { return std::get<PoseBlock>(block.body); }

flow::Run run_of(const PoseFlow& flow, const flow::RunOptions& options) {
  Diagnostics diagnostics;
  auto run = flow::run(flow, options, diagnostics);
  EXPECT_TRUE(run) << run.error().message;
  return run ? std::move(*run) : flow::Run{};
}

std::vector<std::size_t> path_of(const flow::Run& run) {
  std::vector<std::size_t> path;
  for (const flow::Step& step : run.path) path.push_back(step.block);
  return path;
}

std::vector<int> slider_of(const flow::Run& run, std::size_t slider) {
  std::vector<int> values;
  for (std::size_t tick = 0; tick <= run.num_ticks; ++tick) {
    values.push_back(run.sliders[tick * run.num_sliders + slider]);
  }
  return values;
}

}  // namespace kinefile::test
