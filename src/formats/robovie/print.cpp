// SPDX-License-Identifier: MIT
#include "formats/robovie/print.hpp"

#include <fmt/format.h>

#include "model/slider_words.hpp"

namespace kinefile::robovie {
namespace {

std::string words_text(const std::vector<SliderWord>& words) {
  std::string text;
  text.reserve(words.size() * 7);
  for (const SliderWord& word : words) {
    if (!text.empty()) text += ',';
    text += word_text(word);
  }
  return text;
}

struct BodyText {
  std::string operator()(const StartBlock&) const { return "_STARTMOT:"; }
  std::string operator()(const EndBlock&) const { return "_ENDMOT:"; }
  std::string operator()(const LoopBlock&) const { return "_OLDLOOP:"; }
  std::string operator()(const PoseBlock& pose) const {
    return fmt::format("_POSE:[{}]-[{}]-[[{}]]-[{}]", pose.ticks, words_text(pose.words),
                       pose.sound, servo_mask_text(pose.servo_off));
  }
  std::string operator()(const ArithmeticBlock& block) const {
    return fmt::format("{}:[{}]-[{}]-[{}]", block.has_variable_operand ? "_VARVAR" : "_VARCON",
                       block.variable, static_cast<int>(block.operation), block.operand);
  }
  std::string operator()(const BranchBlock& block) const {
    return fmt::format("_MIF:[{}]-[{}]-[{}]", block.variable, static_cast<int>(block.condition),
                       block.detail);
  }
};

/// Whether a text can be written in doubled brackets and be read again.
bool is_text(std::string_view text) {
  return text.find_first_of("\r\n") == std::string_view::npos &&
         text.find("]]-[") == std::string_view::npos;
}

std::string why_not_pose(const PoseBlock& pose, const PoseFlow& flow) {
  if (pose.words.size() != flow.num_sliders) {
    return fmt::format("it has {} words, not {}", pose.words.size(), flow.num_sliders);
  }
  if (pose.ticks < 1 || pose.ticks > kMaxTicks) {
    return fmt::format("its time is {} ticks, not 1 to {}", pose.ticks, kMaxTicks);
  }
  return is_text(pose.sound) ? "" : "its sound holds ']]-[' or the end of a line";
}

std::string why_not_block(const Block& block, const PoseFlow& flow) {
  const auto is_arrow = [&flow](int arrow) {
    return arrow >= kNoBlock && arrow < static_cast<int>(flow.blocks.size());
  };
  if (!is_arrow(block.normal) || !is_arrow(block.branch)) return "an arrow leads to no block";
  if (!is_text(block.name)) return "its name holds ']]-[' or the end of a line";
  const PoseBlock* const pose = std::get_if<PoseBlock>(&block.body);
  if (pose != nullptr) return why_not_pose(*pose, flow);
  return flow.format == FlowFormat::WordN ? "POSEDEF_WORD_N has poses alone" : "";
}

}  // namespace

std::string header_text(const PoseFlow& flow) {
  return fmt::format("_MOTION_FORMAT:[ {} ]\n_ENABLE_AXIS:[{}]\n", header_word(flow.format),
                     flow.num_sliders);
}

std::string block_text(const PoseFlow& flow, const Block& block) {
  if (flow.format == FlowFormat::WordN) {
    const PoseBlock& pose = std::get<PoseBlock>(block.body);
    return fmt::format("_POSE:[{}]-[{}]-[{}]-[{}]-[[{}]]\n", pose.ticks, words_text(pose.words),
                       block.normal, block.branch, pose.sound);
  }
  return fmt::format("_MOTION_INFO:[[{}]]-[{}]-[{}]-[{}]-[{}]-[{}]-[{}]\n{}\n", block.name, block.x,
                     block.y, block.normal_turn, block.branch_turn, block.normal, block.branch,
                     std::visit(BodyText{}, block.body));
}

std::string why_not_written(const PoseFlow& flow) {
  if (flow.num_sliders < 1 || flow.num_sliders > max_sliders(flow.format)) {
    return fmt::format("it has {} sliders, not 1 to {}", flow.num_sliders,
                       max_sliders(flow.format));
  }
  for (std::size_t b = 0; b < flow.blocks.size(); ++b) {
    const std::string why = why_not_block(flow.blocks[b], flow);
    if (!why.empty()) return fmt::format("block {}: {}", b, why);
  }
  return {};
}

}  // namespace kinefile::robovie
