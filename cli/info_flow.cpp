// SPDX-License-Identifier: MIT
#include "info_flow.hpp"

#include <fmt/format.h>

namespace kinefile::cli {
namespace {

std::string flow_extra(const Document& document, const std::string& key) {
  const auto found = document.extras.file.find(key);
  return found == document.extras.file.end() ? "" : found->second;
}

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

std::string flow_text(const std::string& path, const Document& document, const FlowInfo& flow) {
  std::string text = fmt::format("{}: {} {}\n", path, document.format, kind_name(document));
  const auto line = [&text](std::string_view key, const std::string& value) {
    text += fmt::format("  {:<12}{}\n", key, value);
  };
  std::string dialect(header_word(flow.format));
  const std::string encoding = flow_extra(document, "encoding");
  if (!encoding.empty()) {
    dialect += fmt::format(", {}, line ends {}", encoding, flow_extra(document, "line_end"));
  }
  line("dialect", dialect);
  line("sliders", fmt::format("{}", flow.num_sliders));
  std::string kinds;
  for (const BlockCount& count : flow.blocks) {
    kinds += fmt::format("{}{} {}", kinds.empty() ? ": " : ", ", count.kind, count.num_blocks);
  }
  line("blocks", fmt::format("{}{}", flow.num_blocks, kinds));
  return text;
}

Json flow_json(const std::string& path, const Document& document, const FlowInfo& flow,
               bool with_poses) {
  Json json = {{"file", path}, {"format", document.format}, {"kind", kind_name(document)}};
  for (const auto& [key, value] : document.extras.file) json[key] = value;
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
