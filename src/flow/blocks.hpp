// SPDX-License-Identifier: MIT
// Blocks of flows as the editor makes them, and changes of their arrows.
#pragma once

#include <limits>
#include <vector>

#include "kinefile/flow.hpp"

namespace kinefile::flow {

/// The vertical distance of blocks in the editor.
inline constexpr int kRowHeight = 54;
/// The positions of the start block and of the block below it in the editor.
inline constexpr int kColumn = 50, kStartRow = 10, kFirstRow = 46;

/// A position moved down in the editor, clamped to its range.
constexpr int moved_by(int place, int distance) {
  constexpr int kFarthest = std::numeric_limits<int>::max();
  return place > kFarthest - distance ? kFarthest : place + distance;
}

/// A block as the editor makes it, without arrows.
inline Block new_block(BlockBody body, std::string name, int y) {
  const bool is_start = std::holds_alternative<StartBlock>(body);
  const bool is_pose = std::holds_alternative<PoseBlock>(body);
  Block block;
  block.name = std::move(name);
  block.x = kColumn;
  block.y = y;
  block.normal_turn = is_start || is_pose ? 6 : 16;
  block.branch_turn = is_start ? 0 : is_pose ? 6 : 46;
  block.body = std::move(body);
  return block;
}

/// Renumbers all arrows.
/// \param place_of  by old block number: the new block number, or `kNoBlock`
inline void renumber(std::vector<Block>& blocks, const std::vector<int>& place_of) {
  for (Block& block : blocks) {
    for (int* arrow : {&block.normal, &block.branch}) {
      if (*arrow != kNoBlock) *arrow = place_of[static_cast<std::size_t>(*arrow)];
    }
  }
}

/// The poses of a straight flow, in the order in which they run.
/// \errors FLW003 (Usage) if it loops, branches or computes
Result<std::vector<std::size_t>> straight_way(const PoseFlow& flow);

}  // namespace kinefile::flow
