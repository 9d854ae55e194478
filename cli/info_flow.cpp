// SPDX-License-Identifier: MIT
#include "info_flow.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace kinefile::cli {
namespace {

/// How many blocks there are of each kind that there is, kinds in the order of the model.
std::vector<std::pair<std::string_view, std::size_t>> counts_by_kind(const PoseFlow& flow) {
  std::vector<std::size_t> counts(std::variant_size_v<BlockBody>);
  std::vector<std::string_view> names(counts.size());
  for (const Block& block : flow.blocks) {
    ++counts[block.body.index()];
    names[block.body.index()] = body_name(block);
  }
  std::vector<std::pair<std::string_view, std::size_t>> all;
  for (std::size_t kind = 0; kind < counts.size(); ++kind) {
    if (counts[kind] > 0) all.emplace_back(names[kind], counts[kind]);
  }
  return all;
}

const Slider* slider_of(const RobotProject* project, std::size_t number) {
  const bool is_known = project != nullptr && number < project->sliders.size();
  return is_known ? &project->sliders[number] : nullptr;
}

std::string slider_name(const RobotProject* project, std::size_t number) {
  const Slider* const slider = slider_of(project, number);
  return slider == nullptr || slider->name.empty() ? fmt::format("s{}", number) : slider->name;
}

/// The degrees of a word, where the project shows the slider in degrees.
std::optional<double> degrees_of(const RobotProject* project, std::size_t number, int value) {
  const Slider* const slider = slider_of(project, number);
  if (slider == nullptr || slider->units_per_degree <= 0) return std::nullopt;
  return value / slider->units_per_degree;
}

std::string word_text(const RobotProject* project, std::size_t number, std::int16_t value) {
  const auto degrees = degrees_of(project, number, value);
  const std::string name = slider_name(project, number);
  if (degrees) return fmt::format("{} {:.2f} deg", name, *degrees);
  return fmt::format("{} 0x{:04x}", name, static_cast<std::uint16_t>(value));
}

Json pose_json(const PoseBlock& pose, const RobotProject* project) {
  Json sliders = Json::array();
  for (std::size_t s = 0; s < pose.words.size(); ++s) {
    if (!pose.words[s].is_enabled) continue;
    Json slider = {{"slider", s}, {"name", slider_name(project, s)}, {"word", pose.words[s].value}};
    if (const auto degrees = degrees_of(project, s, pose.words[s].value)) {
      slider["degrees"] = *degrees;
    }
    sliders.push_back(std::move(slider));
  }
  return {{"ticks", pose.ticks}, {"sound", pose.sound}, {"sliders", std::move(sliders)}};
}

}  // namespace

void add_facts(Json& json, const Document& document) {
  std::vector<Fact> facts = facts_of(document);
  std::sort(facts.begin(), facts.end(), [](const Fact& a, const Fact& b) { return a.key < b.key; });
  for (Fact& fact : facts) json[fact.key] = std::move(fact.value);
}

std::string flow_text(const std::string& path, const Document& document) {
  const PoseFlow& flow = *std::get_if<PoseFlow>(&document.content);
  std::string text = fmt::format("{}: {} {}\n", path, document.format, kind_name(document));
  const auto line = [&text](std::string_view key, const std::string& value) {
    text += fmt::format("  {:<12}{}\n", key, value);
  };
  std::string dialect(header_word(flow.format));
  for (const Fact& fact : facts_of(document)) {
    if (!fact.words.empty()) dialect += ", " + fact.words;
  }
  line("dialect", dialect);
  line("sliders", fmt::format("{}", flow.num_sliders));
  std::string kinds;
  for (const auto& [kind, count] : counts_by_kind(flow)) {
    kinds += fmt::format("{}{} {}", kinds.empty() ? ": " : ", ", kind, count);
  }
  line("blocks", fmt::format("{}{}", flow.blocks.size(), kinds));
  return text;
}

Json flow_json(const std::string& path, const Document& document, bool with_poses,
               const RobotProject* project) {
  const PoseFlow& flow = *std::get_if<PoseFlow>(&document.content);
  Json json = {{"file", path}, {"format", document.format}, {"kind", kind_name(document)}};
  add_facts(json, document);
  json["flow_format"] = header_word(flow.format);
  json["num_sliders"] = flow.num_sliders;
  json["num_blocks"] = flow.blocks.size();
  json["blocks"] = Json::object();
  for (const auto& [kind, count] : counts_by_kind(flow)) json["blocks"][std::string(kind)] = count;
  if (!with_poses) return json;
  json["poses"] = Json::array();
  for (std::size_t b = 0; b < flow.blocks.size(); ++b) {
    const PoseBlock* const pose = std::get_if<PoseBlock>(&flow.blocks[b].body);
    if (pose == nullptr) continue;
    Json item = {{"block", b}, {"name", flow.blocks[b].name}};
    item.update(pose_json(*pose, project));
    json["poses"].push_back(std::move(item));
  }
  return json;
}

std::string poses_text(const PoseFlow& flow, const RobotProject* project) {
  std::string text;
  for (std::size_t b = 0; b < flow.blocks.size(); ++b) {
    const PoseBlock* const pose = std::get_if<PoseBlock>(&flow.blocks[b].body);
    if (pose == nullptr) continue;
    text += fmt::format("{} '{}' {} {}", b, flow.blocks[b].name, pose->ticks,
                        pose->ticks == 1 ? "tick" : "ticks");
    std::string_view separator = ": ";
    for (std::size_t s = 0; s < pose->words.size(); ++s) {
      if (!pose->words[s].is_enabled) continue;
      text += separator;
      text += word_text(project, s, pose->words[s].value);
      separator = ", ";
    }
    text += '\n';
  }
  return text;
}

}  // namespace kinefile::cli
