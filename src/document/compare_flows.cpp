// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "document/compare.hpp"
#include "model/slider_words.hpp"

namespace kinefile {
namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

void add_settings(Settings&, const StartBlock&) {}
void add_settings(Settings&, const EndBlock&) {}
void add_settings(Settings&, const LoopBlock&) {}

void add_settings(Settings& settings, const PoseBlock& pose) {
  settings.emplace_back("ticks", fmt::format("{}", pose.ticks));
  for (std::size_t s = 0; s < pose.words.size(); ++s) {
    settings.emplace_back(fmt::format("s{}", s), word_text(pose.words[s]));
  }
  settings.emplace_back("sound", fmt::format("'{}'", pose.sound));
  settings.emplace_back("servo_off", servo_mask_text(pose.servo_off));
}

void add_settings(Settings& settings, const ArithmeticBlock& sum) {
  settings.emplace_back("variable", fmt::format("{}", sum.variable));
  settings.emplace_back("operation", fmt::format("{}", static_cast<int>(sum.operation)));
  settings.emplace_back(
      "operand", fmt::format("{}{}", sum.has_variable_operand ? "variable " : "", sum.operand));
}

void add_settings(Settings& settings, const BranchBlock& branch) {
  settings.emplace_back("variable", fmt::format("{}", branch.variable));
  settings.emplace_back("condition", fmt::format("{}", static_cast<int>(branch.condition)));
  settings.emplace_back("detail", fmt::format("{}", branch.detail));
}

/// The settings of a block, except its place.
Settings settings_of(const PoseFlow& flow, const Block& block) {
  const bool is_word_n = flow.format == FlowFormat::WordN;
  Settings settings = {{"kind", std::string(body_name(block))},
                       {"name", fmt::format("'{}'", block.name)},
                       {is_word_n ? "next" : "normal", fmt::format("{}", block.normal)},
                       {is_word_n ? "break" : "branch", fmt::format("{}", block.branch)}};
  std::visit([&](const auto& body) { add_settings(settings, body); }, block.body);
  return settings;
}

std::string value_of(const Settings& settings, const std::string& what) {
  for (const auto& [name, value] : settings) {
    if (name == what) return value;
  }
  return {};
}

void compare_blocks(std::size_t number, const Settings& first, const Settings& second,
                    std::vector<FlowDifference>& differences) {
  for (const auto& [what, value] : first) {
    const std::string other = value_of(second, what);
    if (value != other) differences.push_back({number, what, value, other});
  }
  for (const auto& [what, value] : second) {
    if (value_of(first, what).empty()) differences.push_back({number, what, "", value});
  }
}

}  // namespace

Comparison compare_flows(const PoseFlow& first, const PoseFlow& second) {
  std::vector<FlowDifference> differences;
  const auto of_whole = [&](const char* what, const std::string& a, const std::string& b) {
    if (a != b) differences.push_back({std::nullopt, what, a, b});
  };
  of_whole("format", std::string(header_word(first.format)),
           std::string(header_word(second.format)));
  of_whole("sliders", fmt::format("{}", first.num_sliders), fmt::format("{}", second.num_sliders));
  of_whole("blocks", fmt::format("{}", first.blocks.size()),
           fmt::format("{}", second.blocks.size()));
  const std::size_t count = std::max(first.blocks.size(), second.blocks.size());
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_in_both = i < first.blocks.size() && i < second.blocks.size();
    if (is_in_both) {
      compare_blocks(i, settings_of(first, first.blocks[i]), settings_of(second, second.blocks[i]),
                     differences);
    } else if (i < first.blocks.size()) {
      differences.push_back({i, "kind", std::string(body_name(first.blocks[i])), ""});
    } else {
      differences.push_back({i, "kind", "", std::string(body_name(second.blocks[i]))});
    }
  }
  const bool is_different = !differences.empty();
  return {FlowComparison{std::move(differences)}, is_different};
}

}  // namespace kinefile
