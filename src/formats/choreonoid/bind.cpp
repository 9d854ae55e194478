// SPDX-License-Identifier: MIT
#include "formats/choreonoid/bind.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace kinefile::choreonoid {
namespace {

Timeline timeline_of(SeqComponent& component, std::optional<double> fps) {
  const std::optional<double> rate = fps ? fps : component.frame_rate;
  if (component.times.empty()) return {FrameRate{rate.value_or(0)}, 0};
  return {FrameTimes{std::move(component.times), rate}, 0};
}

/// Converts quaternions with w last to the order w x y z.
void put_w_first(Array<double>& array) {
  const std::span<double> values = array.mutate();
  for (std::size_t i = 0; i + 7 <= values.size(); i += 7) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(i);
    std::rotate(first + 3, first + 6, first + 7);
  }
}

Component bind_component(SeqComponent&& from, std::optional<double> fps, int version) {
  Component component;
  component.kind = from.kind;
  component.content = usual_content(from);
  component.num_parts = from.num_parts;
  component.num_frames = from.num_frames;
  component.timeline = timeline_of(from, fps);
  component.values = std::move(from.values);
  component.is_root_relative = from.is_root_relative;
  component.kept =
      Kept(KeptComponent{from.type, from.content, from.pose_order, from.unknown_keys, from.text});
  if (from.kind == ComponentKind::Poses) {
    const bool is_rpy = from.pose_order == PoseOrder::RollPitchYaw;
    component.pose_form = is_rpy ? PoseForm::RollPitchYaw : PoseForm::Quaternion;
    if (from.pose_order == PoseOrder::QuaternionWLast) put_w_first(component.values);
  }
  // In format version 1 only the name shows what ZMP is relative to.
  const bool is_called_relative = from.content == "RelativeZMP" || from.content == "RelativeZmp";
  if (is_called_relative) component.is_root_relative = true;
  if (version < 2 && from.content == "ZMP") component.is_root_relative = false;
  return component;
}

}  // namespace

std::string_view usual_content(const SeqComponent& component) {
  const std::string_view content = component.content;
  if (component.kind == ComponentKind::Values &&
      (content == "JointPosition" || content == "MultiJointDisplacementSeq")) {
    return kJointDisplacement;
  }
  if (component.kind == ComponentKind::Poses && content == "MultiLinkPositionSeq") {
    return kLinkPosition;
  }
  const bool is_relative = content == "RelativeZMP" || content == "RelativeZmp";
  if (component.kind == ComponentKind::Vectors && (content == "ZMPSeq" || is_relative)) return kZmp;
  return content;
}

std::string_view word_of(PoseOrder order) {
  constexpr std::array<std::string_view, 3> kWords = {"XYZQWQXQYQZ", "XYZQXQYQZQW", "XYZRPY"};
  return kWords[static_cast<std::size_t>(order)];
}

KeptFile kept_of(const SeqFile& file, const TextLayout& text) {
  return {text,         file.version,      file.is_snake_case,
          file.is_json, file.has_comments, file.unknown_keys};
}

BodyMotion bind(SeqFile&& file, std::optional<double> fps) {
  BodyMotion motion;
  for (SeqComponent& component : file.components) {
    motion.components.push_back(bind_component(std::move(component), fps, file.major));
  }
  return motion;
}

}  // namespace kinefile::choreonoid
