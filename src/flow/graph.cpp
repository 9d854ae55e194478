// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <iterator>

#include "flow/blocks.hpp"
#include "kinefile/flow.hpp"

namespace kinefile::flow {
namespace {

/// Points per pixel of the editor, so that our labels fit into its 54 pixels from block to block.
constexpr double kPointsPerPixel = 1.5;

/// A text for quotes in DOT, where a backslash begins an escape.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return out;
}

std::string text_of(const ArithmeticBlock& sum) {
  constexpr std::string_view kSigns[] = {":=", "+=", "-=", "*=", "/="};
  return fmt::format("v{} {} {}{}", sum.variable, kSigns[static_cast<std::size_t>(sum.operation)],
                     sum.has_variable_operand ? "v" : "", sum.operand);
}

std::string text_of(const BranchBlock& branch) {
  constexpr std::string_view kSigns[] = {"undefined", ">=", "<=", "", "=", "!=", "always", "never"};
  const std::string_view sign = kSigns[static_cast<std::size_t>(branch.condition)];
  switch (branch.condition) {
    case Condition::Undefined:
    case Condition::Always:
    case Condition::Never:
      return std::string(sign);
    case Condition::BitsMatch: {
      const int mask = branch.detail & 0xff;
      return fmt::format("v{} & {:#04x} = {:#04x}?", branch.variable, mask,
                         (branch.detail >> 8) & mask);
    }
    default:
      return fmt::format("v{} {} {}?", branch.variable, sign, branch.detail);
  }
}

std::string text_of(const PoseBlock& pose) {
  std::string text = fmt::format("{} tick{}", pose.ticks, pose.ticks == 1 ? "" : "s");
  if (!pose.sound.empty()) text += "\\n" + escaped(pose.sound);
  if (pose.servo_off.any()) text += fmt::format("\\n{} servos off", pose.servo_off.count());
  return text;
}

/// The label of a block's action; empty if its kind is sufficient.
std::string deed_of(const Block& block) {
  if (const auto* pose = std::get_if<PoseBlock>(&block.body)) return text_of(*pose);
  if (const auto* sum = std::get_if<ArithmeticBlock>(&block.body)) return text_of(*sum);
  if (const auto* branch = std::get_if<BranchBlock>(&block.body)) return text_of(*branch);
  return {};
}

/// The style of each kind of block: start, end, pose, loop, arithmetic, branch.
constexpr std::string_view kLooks[] = {
    "shape=oval",          "shape=oval, peripheries=2",
    "shape=box",           "shape=hexagon, style=filled, fillcolor=\"#ffe9b3\"",
    "shape=parallelogram", "shape=diamond, style=filled, fillcolor=\"#cfe3ff\"",
};
static_assert(std::size(kLooks) == std::variant_size_v<BlockBody>);

std::string node_of(const PoseFlow& flow, std::size_t number, bool is_reached) {
  const Block& block = flow.blocks[number];
  const bool has_places = flow.format == FlowFormat::V1R4;
  const double x = has_places ? block.x : 0;
  const double y = has_places ? block.y : static_cast<double>(number) * kRowHeight;
  std::string label = fmt::format("{} {}", number, body_name(block));
  if (!block.name.empty()) label += " " + escaped(block.name);
  if (const std::string deed = deed_of(block); !deed.empty()) label += "\\n" + deed;
  if (!is_reached) label += "\\nno way leads here";
  const bool ends = !has_places && block.normal == kNoBlock;
  return fmt::format("  b{} [label=\"{}\", pos=\"{},{}!\", {}{}{}];\n", number, label,
                     x * kPointsPerPixel, -y * kPointsPerPixel, kLooks[block.body.index()],
                     ends ? ", peripheries=2" : "",
                     is_reached ? "" : ", color=gray, fontcolor=gray, style=dashed");
}

/// The label of a block's second arrow.
std::string_view branch_name(const Block& block) {
  if (std::holds_alternative<LoopBlock>(block.body)) return "leave";
  return std::holds_alternative<BranchBlock>(block.body) ? "branch" : "break";
}

/// The arrows that can be followed.
std::string drawn_arrows(const PoseFlow& flow, std::size_t number) {
  const Block& block = flow.blocks[number];
  std::string text;
  if (std::holds_alternative<EndBlock>(block.body)) return text;
  if (block.normal != kNoBlock) text += fmt::format("  b{} -> b{};\n", number, block.normal);
  const bool has_branch = flow.format == FlowFormat::WordN ||
                          std::holds_alternative<LoopBlock>(block.body) ||
                          std::holds_alternative<BranchBlock>(block.body);
  if (has_branch && block.branch != kNoBlock) {
    text += fmt::format("  b{} -> b{} [style=dashed, label=\"{}\"];\n", number, block.branch,
                        branch_name(block));
  }
  return text;
}

}  // namespace

std::string graph(const PoseFlow& flow) {
  std::string text =
      "digraph flow {\n"
      "  graph [splines=true];\n"
      "  node [fontname=\"sans-serif\", fontsize=10, height=0.4, margin=\"0.08,0.04\"];\n"
      "  edge [fontname=\"sans-serif\", fontsize=9];\n";
  const std::vector<bool> is_reached = reachable_blocks(flow);
  for (std::size_t b = 0; b < flow.blocks.size(); ++b) text += node_of(flow, b, is_reached[b]);
  for (std::size_t b = 0; b < flow.blocks.size(); ++b) text += drawn_arrows(flow, b);
  return text + "}\n";
}

}  // namespace kinefile::flow
