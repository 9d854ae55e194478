// SPDX-License-Identifier: MIT
// Any bytes as a flow and how it is run: it always stops, rows are as many as it says, and what is
// drawn, converted or edited is a flow again.

#include <algorithm>

#include "checks.hpp"

namespace {

using namespace kinefile;
using fuzz::require;

/// Takes numbers off bytes; zeros when there are no more.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size) {}

  int byte() { return next_ == end_ ? 0 : *next_++; }
  bool flag() { return (byte() & 1) != 0; }
  std::int16_t word() {
    const int low = byte();
    return static_cast<std::int16_t>(low | byte() << 8);
  }
  /// A number below `count`.
  int below(std::size_t count) { return byte() % static_cast<int>(count); }
  /// A block, or none.
  int arrow(std::size_t num_blocks) { return below(num_blocks + 1) - 1; }

 private:
  const std::uint8_t* next_;
  const std::uint8_t* end_;
};

PoseBlock pose_of(Bytes& bytes, std::size_t num_sliders) {
  PoseBlock pose;
  pose.ticks = 1 + bytes.below(kMaxTicks);
  for (std::size_t s = 0; s < num_sliders; ++s) pose.words.push_back({bytes.word(), bytes.flag()});
  if (bytes.flag()) pose.sound = "a.wav";
  return pose;
}

BlockBody body_of(Bytes& bytes, const PoseFlow& flow) {
  const int kind = flow.format == FlowFormat::WordN ? 2 : bytes.below(6);
  if (kind == 0) return StartBlock{};
  if (kind == 1) return EndBlock{};
  if (kind == 3) return LoopBlock{};
  if (kind == 4) {
    const bool has_variable = bytes.flag();
    const int operand = bytes.word();
    return ArithmeticBlock{bytes.byte(), static_cast<Arithmetic>(bytes.below(5)), has_variable,
                           has_variable ? operand & 0xff : operand};
  }
  if (kind == 5) {
    return BranchBlock{bytes.byte(), static_cast<Condition>(bytes.below(8)), bytes.word()};
  }
  PoseBlock pose = pose_of(bytes, flow.num_sliders);
  if (flow.format == FlowFormat::V1R4 && bytes.flag()) {
    pose.servo_off[static_cast<std::size_t>(bytes.below(kNumServos))] = true;
  }
  return pose;
}

PoseFlow flow_of(Bytes& bytes) {
  PoseFlow flow;
  flow.format = bytes.flag() ? FlowFormat::V1R4 : FlowFormat::WordN;
  flow.num_sliders = static_cast<std::size_t>(1 + bytes.below(max_sliders(flow.format)));
  flow.num_sliders = std::min(flow.num_sliders, static_cast<std::size_t>(1 + bytes.below(64)));
  const auto num_blocks = static_cast<std::size_t>(1 + bytes.below(20));
  for (std::size_t b = 0; b < num_blocks; ++b) {
    Block& block = flow.blocks.emplace_back();
    block.body = body_of(bytes, flow);
    block.normal = bytes.arrow(num_blocks);
    block.branch = bytes.arrow(num_blocks);
    block.x = bytes.byte();
    block.y = bytes.flag() ? 0x7fffffff : bytes.byte();
    block.line = b + 1;
    if (bytes.flag()) block.name = "a\"\\";
  }
  return flow;
}

flow::RunOptions options_of(Bytes& bytes) {
  flow::RunOptions options;
  options.num_loops = static_cast<std::uint64_t>(bytes.byte());
  options.max_ticks = static_cast<std::uint64_t>(bytes.byte()) * 8;
  if (bytes.flag()) options.hold_ticks = static_cast<std::uint64_t>(bytes.byte());
  if (bytes.flag()) options.base_pose = {bytes.word(), bytes.word()};
  if (bytes.flag()) options.jumps = {bytes.flag(), bytes.flag()};
  if (bytes.flag()) options.variables.emplace_back(bytes.byte(), bytes.word());
  options.disabled = static_cast<flow::DisabledWords>(bytes.below(3));
  options.true_takes_branch = bytes.flag();
  options.skips_division_by_zero = bytes.flag();
  std::uint64_t tick = 0;
  for (int i = bytes.below(5); i > 0; --i) {
    tick += static_cast<std::uint64_t>(bytes.byte());
    flow::Input& input = options.inputs.emplace_back();
    input.tick = tick;
    if (bytes.flag()) input.is_held = bytes.flag();
    input.variables.emplace_back(bytes.byte(), bytes.word());
  }
  return options;
}

void check_flow(const PoseFlow& flow) {
  for (const Block& block : flow.blocks) {
    for (const int arrow : {block.normal, block.branch}) {
      require(arrow >= kNoBlock && arrow < static_cast<int>(flow.blocks.size()));
    }
    const auto* pose = std::get_if<PoseBlock>(&block.body);
    if (pose == nullptr) continue;
    require(pose->words.size() == flow.num_sliders);
    require(pose->ticks >= 1 && pose->ticks <= kMaxTicks);
  }
}

std::optional<flow::Run> check_run(const PoseFlow& flow, const flow::RunOptions& options) {
  Diagnostics diagnostics;
  auto run = flow::run(flow, options, diagnostics);
  if (!run) return std::nullopt;
  require(run->num_ticks <= options.max_ticks);
  require(run->sliders.size() == (run->num_ticks + 1) * flow.num_sliders);
  require(!run->path.empty() && run->path.back().tick <= run->num_ticks);
  for (const flow::Event& event : run->events) require(event.tick <= run->num_ticks);
  return std::move(*run);
}

/// A flow in the other format runs the same while a button is held or not.
void check_format(const PoseFlow& flow, const flow::RunOptions& options) {
  const FlowFormat other = flow.format == FlowFormat::V1R4 ? FlowFormat::WordN : FlowFormat::V1R4;
  Diagnostics diagnostics;
  const auto made = flow::in_format(flow, other, diagnostics);
  if (!made) return;
  check_flow(*made);
  flow::RunOptions held = options;
  held.inputs.clear();
  held.variables.clear();
  held.hold_ticks = options.num_loops;
  const auto before = check_run(flow, held);
  const auto after = check_run(*made, held);
  if (!before || !after || made->num_sliders != flow.num_sliders) return;
  require(before->sliders == after->sliders);
}

template <class Made>
void check_made(const Made& made) {
  if (made) check_flow(*made);
}

void check_edits(const PoseFlow& flow, Bytes& bytes) {
  Diagnostics diagnostics;
  const auto number = static_cast<std::size_t>(bytes.byte());
  const std::vector<flow::MirrorPair> pairs = {
      {number % 64, static_cast<std::size_t>(bytes.below(64))}};
  check_made(flow::mirror(flow, pairs, diagnostics));
  check_made(flow::reverse(flow));
  check_made(flow::speed(flow, (1 + bytes.byte()) / 64.0, diagnostics));
  check_made(flow::offset(flow, number % 64, bytes.word()));
  check_made(flow::merge(flow, flow, {number % 64}));
  check_made(flow::insert(flow, number % 24, flow));
  check_made(flow::erase(flow, number % 24));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const PoseFlow flow = flow_of(bytes);
  const flow::RunOptions options = options_of(bytes);
  check_run(flow, options);
  require(!flow::graph(flow).empty());
  check_format(flow, options);
  check_edits(flow, bytes);
  return 0;
}
