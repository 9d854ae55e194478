// SPDX-License-Identifier: MIT
#include "kinefile/pose_flow.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace kinefile {

bool operator==(const Block& a, const Block& b) {
  const auto rest = [](const Block& block) {
    return std::tie(block.name, block.x, block.y, block.normal_turn, block.branch_turn,
                    block.normal, block.branch, block.body);
  };
  return rest(a) == rest(b);
}

int first_block(const PoseFlow& flow) {
  if (flow.format == FlowFormat::WordN) return flow.blocks.empty() ? kNoBlock : 0;
  const auto start = std::find_if(flow.blocks.begin(), flow.blocks.end(), [](const Block& block) {
    return std::holds_alternative<StartBlock>(block.body);
  });
  return start == flow.blocks.end() ? kNoBlock : static_cast<int>(start - flow.blocks.begin());
}

std::vector<int> successors(const PoseFlow& flow, std::size_t number) {
  const Block& block = flow.blocks[number];
  std::vector<int> next;
  if (std::holds_alternative<EndBlock>(block.body)) return next;
  if (block.normal != kNoBlock) next.push_back(block.normal);
  const bool has_branch = flow.format == FlowFormat::WordN ||
                          std::holds_alternative<LoopBlock>(block.body) ||
                          std::holds_alternative<BranchBlock>(block.body);
  if (has_branch && block.branch != kNoBlock && block.branch != block.normal) {
    next.push_back(block.branch);
  }
  return next;
}

std::vector<bool> reachable_blocks(const PoseFlow& flow) {
  std::vector<bool> is_reached(flow.blocks.size());
  std::vector<int> waiting;
  if (const int first = first_block(flow); first != kNoBlock) waiting.push_back(first);
  while (!waiting.empty()) {
    const auto block = static_cast<std::size_t>(waiting.back());
    waiting.pop_back();
    if (is_reached[block]) continue;
    is_reached[block] = true;
    for (const int next : successors(flow, block)) waiting.push_back(next);
  }
  return is_reached;
}

std::string_view body_name(const Block& block) {
  constexpr std::string_view kNames[] = {"start", "end", "pose", "loop", "arithmetic", "branch"};
  static_assert(std::size(kNames) == std::variant_size_v<BlockBody>);
  return kNames[block.body.index()];
}

}  // namespace kinefile
