// SPDX-License-Identifier: MIT
// Analyses all paths through a flow, in time linear in the number of blocks, without recursion.

#include <algorithm>
#include <array>
#include <limits>

#include "kinefile/pose_flow.hpp"

namespace kinefile {
namespace {

/// The successors of every block: at most two.
using Ways = std::vector<std::array<int, 2>>;

bool is_pose(const Block& block) { return std::holds_alternative<PoseBlock>(block.body); }
bool is_end(const Block& block) { return std::holds_alternative<EndBlock>(block.body); }

bool may_branch(const Block& block) {
  return std::holds_alternative<LoopBlock>(block.body) ||
         std::holds_alternative<BranchBlock>(block.body);
}

Ways ways_of(const PoseFlow& flow) {
  Ways ways(flow.blocks.size(), {kNoBlock, kNoBlock});
  for (std::size_t b = 0; b < ways.size(); ++b) {
    const std::vector<int> next = successors(flow, b);
    std::copy(next.begin(), next.end(), ways[b].begin());
  }
  return ways;
}

/// Strongly connected groups of blocks: Tarjan's algorithm.
class Cycles {
 public:
  explicit Cycles(const Ways& ways)
      : ways_(ways), order_(ways.size(), kUnseen), low_(ways.size()), group_(ways.size(), kUnseen) {
    for (std::size_t b = 0; b < ways.size(); ++b) {
      if (order_[b] == kUnseen) visit(b);
    }
  }

  std::size_t num_groups() const { return num_groups_; }
  std::size_t group_of(std::size_t block) const { return group_[block]; }

 private:
  static constexpr std::size_t kUnseen = std::numeric_limits<std::size_t>::max();

  struct Step {
    std::size_t block;
    std::size_t next_way;
  };

  void enter(std::size_t block) {
    order_[block] = low_[block] = num_seen_++;
    path_.push_back(block);
    steps_.push_back({block, 0});
  }

  void close_group(std::size_t first) {
    std::size_t block = kUnseen;
    do {
      block = path_.back();
      path_.pop_back();
      group_[block] = num_groups_;
    } while (block != first);
    ++num_groups_;
  }

  void leave(std::size_t block) {
    steps_.pop_back();
    if (low_[block] == order_[block]) close_group(block);
    if (steps_.empty()) return;
    const std::size_t before = steps_.back().block;
    low_[before] = std::min(low_[before], low_[block]);
  }

  void visit(std::size_t start) {
    enter(start);
    while (!steps_.empty()) {
      Step& step = steps_.back();
      const std::size_t block = step.block;
      if (step.next_way == ways_[block].size()) {
        leave(block);
        continue;
      }
      const int way = ways_[block][step.next_way++];
      if (way == kNoBlock) continue;
      const auto next = static_cast<std::size_t>(way);
      if (order_[next] == kUnseen) {
        enter(next);
      } else if (group_[next] == kUnseen) {  // still on the path
        low_[block] = std::min(low_[block], order_[next]);
      }
    }
  }

  const Ways& ways_;
  std::vector<std::size_t> order_, low_, group_;
  std::vector<std::size_t> path_;
  std::vector<Step> steps_;
  std::size_t num_seen_ = 0;
  std::size_t num_groups_ = 0;
};

/// Properties of a group of blocks.
struct Group {
  std::size_t first = std::numeric_limits<std::size_t>::max();
  bool goes_round = false;  ///< some arrow leads from a block of the group to one of the group
  bool can_leave = false;   ///< some arrow leads out of the group, or nowhere
  bool has_pose = false;
};

/// Whether a flow can stop at a block, because an arrow that it may follow leads nowhere.
bool may_stop(const PoseFlow& flow, const Block& block) {
  if (is_end(block) || block.normal == kNoBlock) return true;
  return flow.format == FlowFormat::V1R4 && may_branch(block) && block.branch == kNoBlock;
}

std::vector<Group> groups_of(const PoseFlow& flow, const Ways& ways,
                             const std::vector<bool>& is_wanted) {
  const Cycles cycles(ways);
  std::vector<Group> groups(cycles.num_groups());
  for (std::size_t b = 0; b < ways.size(); ++b) {
    if (!is_wanted[b]) continue;
    Group& group = groups[cycles.group_of(b)];
    group.first = std::min(group.first, b);
    group.has_pose = group.has_pose || is_pose(flow.blocks[b]);
    group.can_leave = group.can_leave || may_stop(flow, flow.blocks[b]);
    for (const int way : ways[b]) {
      if (way == kNoBlock) continue;
      const bool stays = cycles.group_of(static_cast<std::size_t>(way)) == cycles.group_of(b);
      group.goes_round = group.goes_round || stays;
      group.can_leave = group.can_leave || !stays;
    }
  }
  return groups;
}

/// The arrows between blocks that take no time.
Ways without_poses(const PoseFlow& flow, Ways ways) {
  for (std::size_t b = 0; b < ways.size(); ++b) {
    for (int& way : ways[b]) {
      const bool leads_to_pose =
          way != kNoBlock && is_pose(flow.blocks[static_cast<std::size_t>(way)]);
      if (is_pose(flow.blocks[b]) || leads_to_pose) way = kNoBlock;
    }
  }
  return ways;
}

void find_cycles(const PoseFlow& flow, const Ways& ways, const std::vector<bool>& is_reached,
                 std::vector<FlowFinding>& findings) {
  for (const Group& group : groups_of(flow, ways, is_reached)) {
    if (group.goes_round && !group.can_leave && group.has_pose) {
      findings.push_back({FlowFault::EndlessCycle, group.first});
    }
  }
  for (const Group& group : groups_of(flow, without_poses(flow, ways), is_reached)) {
    if (group.goes_round) findings.push_back({FlowFault::CycleWithoutPose, group.first});
  }
}

void find_missing_ways(const PoseFlow& flow, std::size_t number,
                       std::vector<FlowFinding>& findings) {
  const Block& block = flow.blocks[number];
  if (flow.format == FlowFormat::WordN || is_end(block)) return;
  if (block.normal == kNoBlock) findings.push_back({FlowFault::DeadEnd, number});
  if (may_branch(block) && block.branch == kNoBlock) {
    findings.push_back({FlowFault::NoBranch, number});
  }
}

}  // namespace

std::vector<FlowFinding> find_flow_faults(const PoseFlow& flow) {
  std::vector<FlowFinding> findings;
  if (flow.blocks.empty()) return findings;
  const Ways ways = ways_of(flow);
  const int first = first_block(flow);
  const std::vector<bool> is_reached =
      first == kNoBlock ? std::vector<bool>(ways.size(), true) : reachable_blocks(flow);
  for (std::size_t b = 0; b < ways.size(); ++b) {
    if (is_reached[b]) {
      find_missing_ways(flow, b, findings);
    } else {
      findings.push_back({FlowFault::Unreachable, b});
    }
  }
  find_cycles(flow, ways, is_reached, findings);
  const bool has_end = std::any_of(flow.blocks.begin(), flow.blocks.end(), is_end);
  if (flow.format == FlowFormat::V1R4 && !has_end) findings.push_back({FlowFault::NoEnd, 0});
  std::stable_sort(findings.begin(), findings.end(),
                   [](const FlowFinding& a, const FlowFinding& b) { return a.block < b.block; });
  return findings;
}

}  // namespace kinefile
