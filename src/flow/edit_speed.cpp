// SPDX-License-Identifier: MIT
// Changes the speed of a flow; poses that become too long are split.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "flow/blocks.hpp"
#include "flow/machine.hpp"

namespace kinefile::flow {
namespace {

using Words = std::vector<SliderWord>;

constexpr double kMostBlocks = 100'000;
/// The horizontal distance of the parts of a pose in the editor.
constexpr int kPartDistance = 90;

tl::unexpected<Error> refuse_speed(std::string message) {
  return fail(make_error(ErrorKind::Usage, "FLW004", std::move(message)));
}

/// By block: its predecessors.
std::vector<std::vector<std::size_t>> predecessors(const PoseFlow& flow) {
  std::vector<std::vector<std::size_t>> before(flow.blocks.size());
  for (std::size_t b = 0; b < flow.blocks.size(); ++b) {
    for (const int next : successors(flow, b)) before[static_cast<std::size_t>(next)].push_back(b);
  }
  return before;
}

/// The words of the sliders when a pose begins, if they are the same on every path: those of the
/// previous poses, through blocks that take no time. Null at the start of a flow, where the robot's
/// pose is unknown.
const Words* words_before(const PoseFlow& flow, const std::vector<std::vector<std::size_t>>& before,
                          std::size_t pose) {
  constexpr std::size_t kMostLooked = 1000;  // so that a hostile flow does not take much time
  std::size_t num_looked = 0;
  const Words* words = nullptr;
  std::vector<bool> was_there(flow.blocks.size());
  std::vector<std::size_t> open = {pose};
  while (!open.empty()) {
    const std::size_t block = open.back();
    open.pop_back();
    if (static_cast<int>(block) == first_block(flow)) return nullptr;
    for (const std::size_t earlier : before[block]) {
      if (was_there[earlier]) continue;
      was_there[earlier] = true;
      const BlockBody& body = flow.blocks[earlier].body;
      const auto* sum = std::get_if<ArithmeticBlock>(&body);
      const bool moves =
          sum != nullptr && static_cast<std::size_t>(sum->variable) < flow.num_sliders;
      if (moves || ++num_looked > kMostLooked) return nullptr;
      if (const auto* source = std::get_if<PoseBlock>(&body)) {
        if (words != nullptr && *words != source->words) return nullptr;
        words = &source->words;
      } else {
        open.push_back(earlier);
      }
    }
  }
  return words;
}

/// The words at some ticks of the transition from one pose to another; nothing if they depend on
/// the base pose.
std::optional<Words> words_between(const Words& from, const Words& to, std::int64_t tick,
                                   std::int64_t num_ticks) {
  Words words = to;
  for (std::size_t s = 0; s < to.size(); ++s) {
    if (jumps_by_default(s)) continue;
    if (from[s].is_enabled != to[s].is_enabled) return std::nullopt;
    if (!to[s].is_enabled) continue;
    const std::int64_t way = std::int64_t{to[s].value} - from[s].value;
    words[s].value = static_cast<std::int16_t>(from[s].value + way * tick / num_ticks);
  }
  return words;
}

/// A pose split into several with the same total time; the last one is the pose itself.
std::vector<Block> parted(const Block& block, std::size_t number, std::int64_t num_ticks,
                          const Words* before, Diagnostics& diagnostics) {
  const auto& pose = std::get<PoseBlock>(block.body);
  const std::int64_t count = (num_ticks + kMaxTicks - 1) / kMaxTicks;
  std::vector<Block> parts;
  bool is_on_line = true;
  for (std::int64_t i = 1; i <= count; ++i) {
    const std::int64_t begin = num_ticks * (i - 1) / count;
    const std::int64_t end = num_ticks * i / count;
    Block& part = parts.emplace_back(block);
    auto& body = std::get<PoseBlock>(part.body);
    body.ticks = static_cast<int>(end - begin);
    if (i > 1) body.sound.clear();
    if (i == count) continue;
    part.branch = kNoBlock;
    if (block.x > 0 || block.y > 0) {
      part.x = moved_by(block.x, static_cast<int>(count - i) * kPartDistance);
    }
    const auto words =
        before != nullptr ? words_between(*before, pose.words, end, num_ticks) : std::nullopt;
    if (words) body.words = *words;
    is_on_line = is_on_line && words.has_value();
  }
  if (!is_on_line) {
    diagnostics.add(Severity::Warning, "FLW014",
                    fmt::format("block {} takes {} ticks, and where the robot comes from is not "
                                "said; it is reached after {} and held",
                                number, num_ticks, std::get<PoseBlock>(parts[0].body).ticks));
  }
  return parts;
}

/// The new time of a pose.
std::int64_t ticks_at(double factor, int ticks, std::size_t number, Diagnostics& diagnostics) {
  const double exact = ticks / factor;
  if (exact < 1) {
    diagnostics.add(Severity::Note, "FLW016",
                    fmt::format("block {} would take {:.3g} ticks and takes one", number, exact));
  }
  return std::max(std::int64_t{1}, static_cast<std::int64_t>(std::round(exact)));
}

/// Rejects flows that would have too many blocks.
Result<void> check_length(const PoseFlow& flow, double factor) {
  double num_blocks = 0;
  for (const Block& block : flow.blocks) {
    const auto* pose = std::get_if<PoseBlock>(&block.body);
    num_blocks += pose == nullptr ? 1 : std::max(1.0, pose->ticks / factor / kMaxTicks);
  }
  if (num_blocks <= kMostBlocks) return {};
  return refuse_speed(
      fmt::format("the flow would have {:.3g} blocks, more than {}", num_blocks, kMostBlocks));
}

}  // namespace

Result<PoseFlow> speed(const PoseFlow& flow, double factor, Diagnostics& diagnostics) {
  if (!(factor > 0) || !std::isfinite(factor)) {
    return refuse_speed(fmt::format("expected a factor above 0, found {}", factor));
  }
  if (const auto checked = check_length(flow, factor); !checked) return fail(checked.error());
  const auto before = predecessors(flow);
  PoseFlow made = flow;
  made.blocks.clear();
  std::vector<int> place_of(flow.blocks.size());
  std::vector<bool> is_inner;  // whether a block's normal arrow leads to the next part
  for (std::size_t b = 0; b < flow.blocks.size(); ++b) {
    place_of[b] = static_cast<int>(made.blocks.size());
    const auto* pose = std::get_if<PoseBlock>(&flow.blocks[b].body);
    std::vector<Block> parts = {flow.blocks[b]};
    if (pose != nullptr) {
      const std::int64_t num_ticks = ticks_at(factor, pose->ticks, b, diagnostics);
      const bool is_long = num_ticks > kMaxTicks;
      parts = parted(flow.blocks[b], b, num_ticks,
                     is_long ? words_before(flow, before, b) : nullptr, diagnostics);
    }
    made.blocks.insert(made.blocks.end(), parts.begin(), parts.end());
    is_inner.insert(is_inner.end(), parts.size() - 1, true);
    is_inner.push_back(false);
  }
  renumber(made.blocks, place_of);
  for (std::size_t b = 0; b < made.blocks.size(); ++b) {
    if (is_inner[b]) made.blocks[b].normal = static_cast<int>(b) + 1;
  }
  return made;
}

}  // namespace kinefile::flow
