// SPDX-License-Identifier: MIT
#include "formats/json/flow.hpp"

#include <array>

#include "formats/json/writer.hpp"
#include "model/slider_words.hpp"

namespace kinefile::json {
namespace {

constexpr std::array<std::string_view, 5> kArithmetic = {"assign", "add", "subtract", "multiply",
                                                         "divide"};
constexpr std::array<std::string_view, 8> kConditions = {
    "undefined", "at_least", "at_most", "bits_match", "equal", "not_equal", "always", "never"};

void print_body(text::Printer&, const StartBlock&) {}
void print_body(text::Printer&, const EndBlock&) {}
void print_body(text::Printer&, const LoopBlock&) {}

void print_body(text::Printer& printer, const PoseBlock& pose) {
  printer.print(fmt::format(",\"ticks\":{},\"words\":", pose.ticks));
  print_elements(printer, pose.words.size(), ",", [&](std::size_t i) {
    printer.print(text::json_string(word_text(pose.words[i])));
  });
  printer.print(",\"sound\":");
  printer.print(text::json_string(pose.sound));
  printer.print(fmt::format(",\"servo_off\":\"{}\"", servo_mask_text(pose.servo_off)));
}

void print_body(text::Printer& printer, const ArithmeticBlock& sum) {
  printer.print(fmt::format(
      ",\"variable\":{},\"operation\":\"{}\",\"operand\":{},\"has_variable_operand\":{}",
      sum.variable, kArithmetic[static_cast<std::size_t>(sum.operation)], sum.operand,
      sum.has_variable_operand));
}

void print_body(text::Printer& printer, const BranchBlock& branch) {
  printer.print(fmt::format(",\"variable\":{},\"condition\":\"{}\",\"detail\":{}", branch.variable,
                            kConditions[static_cast<std::size_t>(branch.condition)],
                            branch.detail));
}

void print_block(text::Printer& printer, const Block& block, std::size_t number) {
  printer.print(fmt::format("{{\"number\":{},\"kind\":\"{}\",\"name\":", number, body_name(block)));
  printer.print(text::json_string(block.name));
  printer.print(fmt::format(
      ",\"x\":{},\"y\":{},\"normal_turn\":{},\"branch_turn\":{},\"normal\":{},\"branch\":{}",
      block.x, block.y, block.normal_turn, block.branch_turn, block.normal, block.branch));
  std::visit([&](const auto& body) { print_body(printer, body); }, block.body);
  printer.print('}');
}

}  // namespace

void print_flow(text::Printer& printer, const PoseFlow& flow) {
  printer.print(fmt::format("{{\"flow_format\":\"{}\",\"enable_axis\":{},\n\"blocks\":",
                            header_word(flow.format), flow.num_sliders));
  print_elements(printer, flow.blocks.size(), ",\n  ",
                 [&](std::size_t i) { print_block(printer, flow.blocks[i], i); });
  printer.print("}\n");
}

}  // namespace kinefile::json
