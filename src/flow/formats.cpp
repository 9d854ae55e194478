// SPDX-License-Identifier: MIT
// WORD_N has only poses, some of which check whether to continue; V1R4 has separate blocks for such
// checks.

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "flow/blocks.hpp"

namespace kinefile::flow {
namespace {

tl::unexpected<Error> refuse_block(const PoseFlow& flow, std::size_t block,
                                   std::string_view reason) {
  Error error = make_error(ErrorKind::DataLoss, "FLW001",
                           fmt::format("WORD_N cannot say it: block {} {}", block, reason));
  error.place.line = flow.blocks[block].line;
  error.place.column = error.place.line > 0 ? 1 : 0;
  return fail(std::move(error));
}

/// Removes the sliders that V1R4 does not have.
void cut_sliders(PoseFlow& flow, Diagnostics& diagnostics) {
  const std::size_t most = max_sliders(FlowFormat::V1R4);
  if (flow.num_sliders <= most) return;
  bool loses = false;
  for (Block& block : flow.blocks) {
    auto& words = std::get<PoseBlock>(block.body).words;
    loses = loses || std::any_of(words.begin() + static_cast<std::ptrdiff_t>(most), words.end(),
                                 [](const SliderWord& word) { return word.is_enabled; });
    words.resize(most);
  }
  flow.num_sliders = most;
  if (!loses) return;
  diagnostics.add(Severity::Warning, "FLW008",
                  "V1R4 has sliders 0 to 61; the words of sliders 62 and 63 are left out");
}

bool asks(const Block& pose) { return pose.branch != kNoBlock; }

PoseFlow as_v1r4(PoseFlow source, Diagnostics& diagnostics) {
  cut_sliders(source, diagnostics);
  const std::size_t num_poses = source.blocks.size();
  std::vector<int> place_of(num_poses);
  int place = 1;
  for (std::size_t p = 0; p < num_poses; ++p) {
    place_of[p] = place;
    place += asks(source.blocks[p]) ? 2 : 1;
  }
  const int end = place;
  const auto target = [&](int pose) {
    return pose == kNoBlock ? end : place_of[static_cast<std::size_t>(pose)];
  };
  PoseFlow made;
  made.format = FlowFormat::V1R4;
  made.num_sliders = source.num_sliders;
  const auto add = [&made](BlockBody body, std::string name, int normal) -> Block& {
    const int row = static_cast<int>(made.blocks.size()) - 1;
    const int y = row < 0 ? kStartRow : moved_by(row * kRowHeight, kFirstRow);
    Block& block = made.blocks.emplace_back(new_block(std::move(body), std::move(name), y));
    block.normal = normal;
    return block;
  };
  add(StartBlock{}, "", num_poses == 0 ? end : 1);
  for (std::size_t p = 0; p < num_poses; ++p) {
    Block& pose = source.blocks[p];
    const int next = target(pose.normal);
    const int after = static_cast<int>(made.blocks.size()) + 1;
    add(std::move(pose.body), fmt::format("POSE {}", p), asks(pose) ? after : next).line =
        pose.line;
    if (asks(pose)) add(LoopBlock{}, "LOOP", next).branch = target(pose.branch);
  }
  add(EndBlock{}, "   END   ", kNoBlock);
  return made;
}

/// The first feature of a flow that WORD_N cannot express; nothing if there is none.
std::optional<tl::unexpected<Error>> unsayable(const PoseFlow& flow) {
  for (std::size_t b = 0; b < flow.blocks.size(); ++b) {
    const BlockBody& body = flow.blocks[b].body;
    if (std::holds_alternative<ArithmeticBlock>(body)) return refuse_block(flow, b, "computes");
    if (std::holds_alternative<BranchBlock>(body)) return refuse_block(flow, b, "branches");
    const auto* pose = std::get_if<PoseBlock>(&body);
    if (pose != nullptr && pose->servo_off.any()) {
      return refuse_block(flow, b, "switches servos off");
    }
  }
  return std::nullopt;
}

/// The target of an arrow; start blocks are skipped.
int behind_start(const PoseFlow& flow, int target) {
  for (std::size_t i = 0; i < flow.blocks.size() && target != kNoBlock; ++i) {
    const Block& block = flow.blocks[static_cast<std::size_t>(target)];
    if (!std::holds_alternative<StartBlock>(block.body)) break;
    target = block.normal;
  }
  return target;
}

/// Whether a flow's arrow leads to a block of this kind.
template <class Body>
bool leads_to(const PoseFlow& flow, int target) {
  return target != kNoBlock &&
         std::holds_alternative<Body>(flow.blocks[static_cast<std::size_t>(target)].body);
}

/// The two arrows of a WORD_N pose, as V1R4 block numbers.
struct PoseArrows {
  int next = kNoBlock;
  int leave = kNoBlock;
};

/// Reads a pose's arrows through the loop block that may follow it.
Result<PoseArrows> arrows_of(const PoseFlow& flow, std::size_t pose) {
  const int target = behind_start(flow, flow.blocks[pose].normal);
  if (!leads_to<LoopBlock>(flow, target)) {
    return PoseArrows{leads_to<PoseBlock>(flow, target) ? target : kNoBlock, kNoBlock};
  }
  const auto loop = static_cast<std::size_t>(target);
  const PoseArrows arrows = {behind_start(flow, flow.blocks[loop].normal),
                             behind_start(flow, flow.blocks[loop].branch)};
  if (leads_to<LoopBlock>(flow, arrows.next) || leads_to<LoopBlock>(flow, arrows.leave)) {
    return refuse_block(flow, loop, "is a loop that leads to a loop, with no pose between");
  }
  if (!leads_to<PoseBlock>(flow, arrows.leave)) {
    return refuse_block(
        flow, loop,
        "is a loop whose branch leads to the end, and a break leads to a pose; put one "
        "before the end");
  }
  return PoseArrows{leads_to<PoseBlock>(flow, arrows.next) ? arrows.next : kNoBlock, arrows.leave};
}

/// Reports loop blocks that no arrow leads to: they are removed.
void report_lost_loops(const PoseFlow& flow, Diagnostics& diagnostics) {
  std::vector<bool> is_entered(flow.blocks.size());
  for (const Block& block : flow.blocks) {
    for (const int target : {block.normal, block.branch}) {
      if (target != kNoBlock) is_entered[static_cast<std::size_t>(target)] = true;
    }
  }
  for (std::size_t b = 0; b < flow.blocks.size(); ++b) {
    if (is_entered[b] || !std::holds_alternative<LoopBlock>(flow.blocks[b].body)) continue;
    diagnostics.add(Severity::Warning, "FLW009",
                    fmt::format("loop block {} is left out: no arrow leads to it", b));
  }
}

/// The poses in the order of the file, except that the first pose of the flow comes first.
/// \errors FLW001 if it does not begin with a pose
Result<std::vector<std::size_t>> poses_in_order(const PoseFlow& flow) {
  const int start = first_block(flow);
  const int first = start == kNoBlock ? kNoBlock : behind_start(flow, start);
  if (!leads_to<PoseBlock>(flow, first)) {
    return refuse_block(flow, static_cast<std::size_t>(std::max(start, 0)),
                        "is not followed by a pose, and a flow begins with one");
  }
  std::vector<std::size_t> poses = {static_cast<std::size_t>(first)};
  for (std::size_t b = 0; b < flow.blocks.size(); ++b) {
    if (b != poses[0] && std::holds_alternative<PoseBlock>(flow.blocks[b].body)) poses.push_back(b);
  }
  return poses;
}

/// Writes a pose that leads to itself twice, each leading to the other: WORD_N's poses cannot lead
/// to themselves. The flow runs the same while a button is held.
void part_from_itself(PoseFlow& flow, std::size_t number, Diagnostics& diagnostics) {
  const int self = static_cast<int>(number);
  if (flow.blocks[number].normal != self && flow.blocks[number].branch != self) return;
  Block twin = flow.blocks[number];
  const int other = static_cast<int>(flow.blocks.size());
  for (int* arrow : {&flow.blocks[number].normal, &flow.blocks[number].branch}) {
    if (*arrow == self) *arrow = other;
  }
  flow.blocks.push_back(std::move(twin));
  diagnostics.add(
      Severity::Note, "FLW010",
      fmt::format("pose {} leads to itself and is written twice, as pose {}, too", number, other));
}

Result<PoseFlow> as_word_n(const PoseFlow& source, Diagnostics& diagnostics) {
  if (source.blocks.empty()) {
    return fail(make_error(ErrorKind::DataLoss, "FLW001", "WORD_N cannot say it: no blocks"));
  }
  if (auto refused = unsayable(source)) return std::move(*refused);
  const auto poses = poses_in_order(source);
  if (!poses) return fail(poses.error());
  report_lost_loops(source, diagnostics);
  std::vector<int> place_of(source.blocks.size(), kNoBlock);
  for (std::size_t p = 0; p < poses->size(); ++p) place_of[(*poses)[p]] = static_cast<int>(p);
  PoseFlow made;
  made.format = FlowFormat::WordN;
  made.num_sliders = source.num_sliders;
  for (const std::size_t pose : *poses) {
    const auto arrows = arrows_of(source, pose);
    if (!arrows) return fail(arrows.error());
    Block& block = made.blocks.emplace_back();
    block.body = source.blocks[pose].body;
    block.line = source.blocks[pose].line;
    block.normal = arrows->next;
    block.branch = arrows->leave;
  }
  renumber(made.blocks, place_of);
  for (std::size_t p = 0; p < poses->size(); ++p) part_from_itself(made, p, diagnostics);
  Diagnostics ignored;
  if (as_v1r4(made, ignored) != source) {
    diagnostics.add(Severity::Warning, "FLW011",
                    "WORD_N has no names and places of blocks; they are left out");
  }
  return made;
}

}  // namespace

Result<PoseFlow> in_format(const PoseFlow& flow, FlowFormat format, Diagnostics& diagnostics) {
  if (flow.format == format) return flow;
  if (format == FlowFormat::V1R4) return as_v1r4(flow, diagnostics);
  return as_word_n(flow, diagnostics);
}

}  // namespace kinefile::flow
