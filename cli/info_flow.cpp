// SPDX-License-Identifier: MIT
#include "info_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace kinefile::cli {
namespace {

std::string slider_text(const SliderInfo& slider) {
  if (slider.degrees) return fmt::format("{} {:.2f} deg", slider.name, *slider.degrees);
  return fmt::format("{} 0x{:04x}", slider.name, static_cast<std::uint16_t>(slider.word));
}

Json pose_json(const PoseInfo& pose) {
  Json sliders = Json::array();
  for (const SliderInfo& info : pose.sliders) {
    Json slider = {{"slider", info.slider}, {"name", info.name}, {"word", info.word}};
    if (info.degrees) slider["degrees"] = *info.degrees;
    sliders.push_back(std::move(slider));
  }
  return {{"block", pose.block},
          {"name", pose.name},
          {"ticks", pose.ticks},
          {"sound", pose.sound},
          {"sliders", std::move(sliders)}};
}

}  // namespace

std::string dialect_text(const std::vector<Fact>& facts) {
  std::string text;
  for (const Fact& fact : facts) {
    if (!fact.words.empty()) text += (text.empty() ? "" : ", ") + fact.words;
  }
  return text;
}

Json file_json(const std::string& path, const Info& info) {
  Json json = {{"file", path}, {"format", info.format}, {"kind", info.kind}};
  std::vector<Fact> facts = info.facts;
  std::sort(facts.begin(), facts.end(), [](const Fact& a, const Fact& b) { return a.key < b.key; });
  for (Fact& fact : facts) json[fact.key] = std::move(fact.value);
  return json;
}

std::string flow_text(const std::string& path, const Info& info) {
  const FlowInfo& flow = *info.flow;
  std::string text = fmt::format("{}: {} {}\n", path, info.format, info.kind);
  const auto line = [&text](std::string_view key, const std::string& value) {
    text += fmt::format("  {:<12}{}\n", key, value);
  };
  const std::string dialect = dialect_text(info.facts);
  line("dialect", std::string(header_word(flow.format)) + (dialect.empty() ? "" : ", ") + dialect);
  line("sliders", fmt::format("{}", flow.num_sliders));
  std::string kinds;
  for (const BlockCount& count : flow.blocks) {
    kinds += fmt::format("{}{} {}", kinds.empty() ? ": " : ", ", count.kind, count.num_blocks);
  }
  line("blocks", fmt::format("{}{}", flow.num_blocks, kinds));
  return text;
}

Json flow_json(const std::string& path, const Info& info, bool with_poses) {
  const FlowInfo& flow = *info.flow;
  Json json = file_json(path, info);
  json["flow_format"] = header_word(flow.format);
  json["num_sliders"] = flow.num_sliders;
  json["num_blocks"] = flow.num_blocks;
  json["blocks"] = Json::object();
  for (const BlockCount& count : flow.blocks) {
    json["blocks"][std::string(count.kind)] = count.num_blocks;
  }
  if (!with_poses) return json;
  json["poses"] = Json::array();
  for (const PoseInfo& pose : flow.poses) json["poses"].push_back(pose_json(pose));
  return json;
}

std::string poses_text(const std::vector<PoseInfo>& poses) {
  std::string text;
  for (const PoseInfo& pose : poses) {
    text += fmt::format("{} '{}' {} {}", pose.block, pose.name, pose.ticks,
                        pose.ticks == 1 ? "tick" : "ticks");
    std::string_view separator = ": ";
    for (const SliderInfo& slider : pose.sliders) {
      text += separator;
      text += slider_text(slider);
      separator = ", ";
    }
    text += '\n';
  }
  return text;
}

}  // namespace kinefile::cli
