// SPDX-License-Identifier: MIT
// Edits that change only the words of a flow.

#include <fmt/format.h>

#include <limits>

#include "kinefile/flow.hpp"

namespace kinefile::flow {
namespace {

constexpr int kLeastWord = std::numeric_limits<std::int16_t>::min();
constexpr int kMostWord = std::numeric_limits<std::int16_t>::max();

std::string num_sliders_text(const PoseFlow& flow) {
  return fmt::format("expected a slider below {}", flow.num_sliders);
}

/// By slider: which one gets its value when mirrored.
Result<std::vector<const MirrorPair*>> pairs_by_slider(const PoseFlow& flow,
                                                       const std::vector<MirrorPair>& pairs) {
  std::vector<const MirrorPair*> pair_of(flow.num_sliders);
  for (const MirrorPair& pair : pairs) {
    if (pair.sign != 1 && pair.sign != -1) {
      return fail(ErrorKind::Usage, "FLW002",
                  fmt::format("expected a sign of 1 or -1, found {}", pair.sign));
    }
    for (const std::size_t slider : {pair.slider, pair.partner}) {
      if (slider >= flow.num_sliders) {
        return fail(ErrorKind::Usage, "FLW002",
                    fmt::format("{}, found {}", num_sliders_text(flow), slider));
      }
      if (pair_of[slider] != nullptr && pair_of[slider] != &pair) {
        return fail(ErrorKind::Usage, "FLW002", fmt::format("slider {} is in two pairs", slider));
      }
      pair_of[slider] = &pair;
    }
  }
  return pair_of;
}

/// A word times 1 or -1; `was_cut` if that does not fit.
SliderWord signed_word(SliderWord word, int sign, bool& was_cut) {
  const int value = word.value * sign;
  was_cut = was_cut || value > kMostWord;
  word.value = static_cast<std::int16_t>(std::min(value, kMostWord));
  return word;
}

/// Swaps a pair. Returns whether a value did not fit.
bool mirror_pair(PoseBlock& pose, const MirrorPair& pair) {
  bool was_cut = false;
  const SliderWord word = signed_word(pose.words[pair.slider], pair.sign, was_cut);
  if (pair.partner != pair.slider) {
    pose.words[pair.slider] = signed_word(pose.words[pair.partner], pair.sign, was_cut);
  }
  pose.words[pair.partner] = word;
  if (pair.slider < kNumServos && pair.partner < kNumServos) {
    const bool is_off = pose.servo_off[pair.slider];
    pose.servo_off[pair.slider] = pose.servo_off[pair.partner];
    pose.servo_off[pair.partner] = is_off;
  }
  return was_cut;
}

/// Reports a block that reads or writes a slider of a pair: it stays unchanged.
void report_variable(const Block& block, std::size_t number,
                     const std::vector<const MirrorPair*>& pair_of, Diagnostics& diagnostics) {
  const auto report = [&](int variable) {
    const auto slider = static_cast<std::size_t>(variable);
    if (slider >= pair_of.size() || pair_of[slider] == nullptr) return;
    diagnostics.add(Severity::Warning, "FLW012",
                    fmt::format("block {} uses slider {} as a variable, which is not mirrored",
                                number, slider));
  };
  if (const auto* branch = std::get_if<BranchBlock>(&block.body)) report(branch->variable);
  const auto* sum = std::get_if<ArithmeticBlock>(&block.body);
  if (sum == nullptr) return;
  report(sum->variable);
  if (sum->has_variable_operand) report(sum->operand);
}

std::vector<PoseBlock*> poses_of(PoseFlow& flow) {
  std::vector<PoseBlock*> poses;
  for (Block& block : flow.blocks) {
    if (auto* pose = std::get_if<PoseBlock>(&block.body)) poses.push_back(pose);
  }
  return poses;
}

}  // namespace

std::vector<MirrorPair> mirror_pairs_of(const RobotProject& project, std::size_t num_sliders) {
  std::vector<MirrorPair> pairs;
  const std::size_t most = std::min(project.sliders.size(), num_sliders);
  std::vector<bool> is_taken(most);
  for (std::size_t s = 0; s < most; ++s) {
    const Slider& slider = project.sliders[s];
    if (slider.pair == PairKind::None || is_taken[s]) continue;
    const bool is_centre = slider.pair == PairKind::Centre;
    if (!is_centre && slider.partner < 0) continue;
    const std::size_t partner = is_centre ? s : static_cast<std::size_t>(slider.partner);
    if (partner >= most || is_taken[partner]) continue;
    is_taken[s] = is_taken[partner] = true;
    pairs.push_back({s, partner, -1});
  }
  return pairs;
}

Result<PoseFlow> mirror(const PoseFlow& flow, const std::vector<MirrorPair>& pairs,
                        Diagnostics& diagnostics) {
  const auto pair_of = pairs_by_slider(flow, pairs);
  if (!pair_of) return fail(pair_of.error());
  PoseFlow mirrored = flow;
  for (std::size_t b = 0; b < mirrored.blocks.size(); ++b) {
    report_variable(mirrored.blocks[b], b, *pair_of, diagnostics);
    auto* pose = std::get_if<PoseBlock>(&mirrored.blocks[b].body);
    if (pose == nullptr) continue;
    for (const MirrorPair& pair : pairs) {
      if (!mirror_pair(*pose, pair)) continue;
      diagnostics.add(Severity::Note, "FLW013",
                      fmt::format("-32768 becomes 32767 in pose block {}, slider {} or {}", b,
                                  pair.slider, pair.partner));
    }
  }
  return mirrored;
}

Result<PoseFlow> offset(const PoseFlow& flow, std::size_t slider, int offset) {
  if (slider >= flow.num_sliders) {
    return fail(ErrorKind::Usage, "FLW005",
                fmt::format("{}, found {}", num_sliders_text(flow), slider));
  }
  PoseFlow moved = flow;
  for (std::size_t b = 0; b < moved.blocks.size(); ++b) {
    auto* pose = std::get_if<PoseBlock>(&moved.blocks[b].body);
    if (pose == nullptr || !pose->words[slider].is_enabled) continue;
    const std::int64_t value = std::int64_t{pose->words[slider].value} + offset;
    if (value < kLeastWord || value > kMostWord) {
      return fail(ErrorKind::Usage, "FLW005",
                  fmt::format("slider {} would be {} in block {}, and words go from {} to {}",
                              slider, value, b, kLeastWord, kMostWord));
    }
    pose->words[slider].value = static_cast<std::int16_t>(value);
  }
  return moved;
}

Result<PoseFlow> merge(const PoseFlow& flow, const PoseFlow& other,
                       const std::vector<std::size_t>& sliders) {
  PoseFlow merged = flow;
  PoseFlow source = other;
  const auto poses = poses_of(merged);
  const auto others = poses_of(source);
  if (poses.size() != others.size()) {
    return fail(ErrorKind::Usage, "FLW006",
                fmt::format("expected flows with as many poses, found {} and {}", poses.size(),
                            others.size()));
  }
  for (const std::size_t slider : sliders) {
    if (slider >= flow.num_sliders || slider >= other.num_sliders) {
      return fail(ErrorKind::Usage, "FLW006",
                  fmt::format("expected sliders of both flows, below {}, found {}",
                              std::min(flow.num_sliders, other.num_sliders), slider));
    }
    for (std::size_t p = 0; p < poses.size(); ++p) {
      poses[p]->words[slider] = others[p]->words[slider];
    }
  }
  return merged;
}

}  // namespace kinefile::flow
