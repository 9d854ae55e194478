// SPDX-License-Identifier: MIT
// Edits that change the order and the set of a flow's blocks.

#include <fmt/format.h>

#include <algorithm>

#include "flow/blocks.hpp"

namespace kinefile::flow {
namespace {

tl::unexpected<Error> no_such_block(const PoseFlow& flow, std::size_t block) {
  return fail(ErrorKind::Usage, "FLW007",
              fmt::format("expected a block below {}, found {}", flow.blocks.size(), block));
}

/// A pose for another flow, with that flow's number of words.
/// \errors FLW006 if a word of a slider that does not exist there is enabled; FLW001 for servos
///         without power in WORD_N
Result<Block> as_block_of(const PoseFlow& flow, const Block& source) {
  Block block = source;
  auto& pose = std::get<PoseBlock>(block.body);
  for (std::size_t s = flow.num_sliders; s < pose.words.size(); ++s) {
    if (!pose.words[s].is_enabled) continue;
    return fail(ErrorKind::Usage, "FLW006",
                fmt::format("expected poses of {} sliders to insert, found one that sets slider "
                            "{}",
                            flow.num_sliders, s));
  }
  pose.words.resize(flow.num_sliders);
  if (flow.format == FlowFormat::WordN) {
    if (pose.servo_off.any()) {
      return fail(make_error(ErrorKind::DataLoss, "FLW001",
                             "WORD_N cannot say it: an inserted pose switches servos off"));
    }
    block.name.clear();
    block.x = block.y = 0;
  }
  return block;
}

/// Makes room in the editor's drawing below a place.
void move_down(PoseFlow& flow, int y, int distance) {
  if (flow.format == FlowFormat::WordN) return;
  for (Block& block : flow.blocks) {
    if (block.y > y) block.y = moved_by(block.y, distance);
  }
}

/// Puts the pose of `source` into a block, which keeps its number, its place in the drawing and its
/// arrows. The time and the servos come from the pose `way`.
void take_pose(Block& block, const Block& source, const PoseBlock& way) {
  block.name = source.name;
  block.line = source.line;
  PoseBlock pose = std::get<PoseBlock>(source.body);
  pose.ticks = way.ticks;
  pose.servo_off = way.servo_off;
  block.body = std::move(pose);
}

}  // namespace

Result<std::vector<std::size_t>> straight_way(const PoseFlow& flow) {
  std::vector<std::size_t> poses;
  std::vector<bool> was_there(flow.blocks.size());
  for (int next = first_block(flow); next != kNoBlock;) {
    const auto number = static_cast<std::size_t>(next);
    const Block& block = flow.blocks[number];
    const bool is_plain = std::holds_alternative<StartBlock>(block.body) ||
                          std::holds_alternative<EndBlock>(block.body) ||
                          std::holds_alternative<PoseBlock>(block.body);
    const bool has_break = flow.format == FlowFormat::WordN && block.branch != kNoBlock;
    if (was_there[number] || !is_plain || has_break) {
      return fail(ErrorKind::Usage, "FLW003",
                  fmt::format("expected poses that go straight on, found that block {} "
                              "{}",
                              number,
                              was_there[number] ? "is come to again"
                              : has_break       ? "has a break"
                                                : "loops, branches or computes"));
    }
    was_there[number] = true;
    if (std::holds_alternative<EndBlock>(block.body)) break;
    if (std::holds_alternative<PoseBlock>(block.body)) poses.push_back(number);
    next = block.normal;
  }
  return poses;
}

Result<PoseFlow> reverse(const PoseFlow& flow) {
  const auto way = straight_way(flow);
  if (!way) return fail(way.error());
  PoseFlow reversed = flow;
  const std::size_t count = way->size();
  const auto block_at = [&](std::size_t i) -> const Block& { return flow.blocks[(*way)[i]]; };
  for (std::size_t i = 0; i < count; ++i) {
    // The first pose is reached from the robot's current pose, as before.
    const std::size_t time = i == 0 ? 0 : count - i;
    take_pose(reversed.blocks[(*way)[i]], block_at(count - 1 - i),
              std::get<PoseBlock>(block_at(time).body));
  }
  return reversed;
}

Result<PoseFlow> insert(const PoseFlow& flow, std::size_t block, const PoseFlow& other) {
  if (block >= flow.blocks.size()) return no_such_block(flow, block);
  if (std::holds_alternative<EndBlock>(flow.blocks[block].body)) {
    return fail(ErrorKind::Usage, "FLW007",
                fmt::format("block {} is an end, and nothing follows an end", block));
  }
  const auto way = straight_way(other);
  if (!way) return fail(way.error());
  if (way->empty()) return flow;
  const std::size_t count = way->size();
  PoseFlow longer = flow;
  const Block& before = flow.blocks[block];
  move_down(longer, before.y, static_cast<int>(std::min<std::size_t>(count, 10'000)) * kRowHeight);
  std::vector<int> place_of(flow.blocks.size());
  for (std::size_t b = 0; b < place_of.size(); ++b) {
    place_of[b] = static_cast<int>(b > block ? b + count : b);
  }
  renumber(longer.blocks, place_of);
  std::vector<Block> inserted;
  int next = longer.blocks[block].normal;
  for (std::size_t i = count; i-- > 0;) {
    auto made = as_block_of(flow, other.blocks[(*way)[i]]);
    if (!made) return fail(made.error());
    made->normal = next;
    made->branch = kNoBlock;
    made->line = 0;
    if (flow.format == FlowFormat::V1R4) {
      const int row = static_cast<int>(std::min<std::size_t>(i + 1, 10'000));
      made->x = before.x;
      made->y = moved_by(before.y, row * kRowHeight);
    }
    next = static_cast<int>(block + 1 + i);
    inserted.push_back(std::move(*made));
  }
  longer.blocks[block].normal = next;
  longer.blocks.insert(longer.blocks.begin() + static_cast<std::ptrdiff_t>(block) + 1,
                       std::make_move_iterator(inserted.rbegin()),
                       std::make_move_iterator(inserted.rend()));
  return longer;
}

Result<PoseFlow> erase(const PoseFlow& flow, std::size_t block) {
  if (block >= flow.blocks.size()) return no_such_block(flow, block);
  const Block& taken = flow.blocks[block];
  if (std::holds_alternative<StartBlock>(taken.body)) {
    return fail(ErrorKind::Usage, "FLW007",
                fmt::format("block {} is the start, without which nothing runs", block));
  }
  PoseFlow shorter = flow;
  shorter.blocks.erase(shorter.blocks.begin() + static_cast<std::ptrdiff_t>(block));
  std::vector<int> place_of(flow.blocks.size());
  for (std::size_t b = 0; b < place_of.size(); ++b) {
    place_of[b] = static_cast<int>(b > block ? b - 1 : b);
  }
  const bool leads_to_itself = taken.normal == static_cast<int>(block);
  place_of[block] = taken.normal == kNoBlock || leads_to_itself
                        ? kNoBlock
                        : place_of[static_cast<std::size_t>(taken.normal)];
  renumber(shorter.blocks, place_of);
  if (flow.format == FlowFormat::V1R4) return shorter;
  for (std::size_t b = 0; b < shorter.blocks.size(); ++b) {
    const int self = static_cast<int>(b);
    if (shorter.blocks[b].normal != self && shorter.blocks[b].branch != self) continue;
    return fail(ErrorKind::Usage, "FLW007",
                fmt::format("without block {}, pose {} would lead to itself, which "
                            "WORD_N does not allow",
                            block, b));
  }
  return shorter;
}

}  // namespace kinefile::flow
