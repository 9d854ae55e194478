// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "kinefile/flow.hpp"

namespace kinefile::test {

/// Blocks for tests; arrows are numbers of blocks.
Block start_block(int normal);
Block end_block();
/// A pose of as many sliders as values, all enabled.
Block pose_block(int ticks, const std::vector<int>& values, int normal, int branch = kNoBlock);
Block loop_block(int normal, int branch);
Block constant_block(int variable, Arithmetic operation, int constant, int normal);
Block variable_block(int variable, Arithmetic operation, int other, int normal);
Block branch_block(int variable, Condition condition, int detail, int normal, int branch);

/// A flow of these blocks, with lines 10, 20, ...
PoseFlow v1r4_of(std::vector<Block> blocks);
PoseFlow word_n_of(std::vector<Block> blocks);

/// The flow of the format document's example of WORD_N: poses of 40, 10, 10, 30 ticks, the second
/// and third of which loop. Of two sliders.
PoseFlow word_n_loop();
/// The same in V1R4, with one loop block after the third pose, as the editor lays it out.
PoseFlow v1r4_loop();
/// Two poses of 10 ticks three times, by a counter in variable 64.
PoseFlow v1r4_counter();

/// The pose of a block.
PoseBlock& pose_of(Block& block);
const PoseBlock& pose_of(const Block& block);

/// Runs a flow, which must succeed.
flow::Run run_of(const PoseFlow& flow, const flow::RunOptions& options = {});

/// The numbers of the blocks that a run came through.
std::vector<std::size_t> path_of(const flow::Run& run);

/// What a slider was at every tick.
std::vector<int> slider_of(const flow::Run& run, std::size_t slider);

}  // namespace kinefile::test
