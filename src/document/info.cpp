// SPDX-License-Identifier: MIT
#include "kinefile/info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace kinefile {
namespace {

/// The rotation order of a joint; empty if it does not turn.
std::string rotation_order_of(const Joint& joint) {
  std::string order;
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind != DofKind::Rotation) continue;
    Eigen::Index axis = 0;
    const bool is_coordinate_axis = dof.axis.cwiseAbs().maxCoeff(&axis) == 1;
    order += is_coordinate_axis ? "XYZ"[axis] : '?';
  }
  return order;
}

std::vector<RotationOrderInfo> rotation_orders_of(const Skeleton& skeleton) {
  std::map<std::string, std::size_t> counts;
  for (const Joint& joint : skeleton.joints) {
    if (std::string order = rotation_order_of(joint); !order.empty()) ++counts[std::move(order)];
  }
  std::vector<RotationOrderInfo> orders;
  for (const auto& [order, count] : counts) orders.push_back({order, count});
  return orders;
}

template <class Predicate>
std::size_t count_joints(const Skeleton& skeleton, Predicate predicate) {
  return static_cast<std::size_t>(
      std::count_if(skeleton.joints.begin(), skeleton.joints.end(), predicate));
}

bool has_translation(const Joint& joint) {
  return std::any_of(joint.dofs.begin(), joint.dofs.end(),
                     [](const DegreeOfFreedom& dof) { return dof.kind == DofKind::Translation; });
}

SkeletonInfo info_of(const Skeleton& skeleton) {
  SkeletonInfo told;
  told.num_joints = skeleton.joints.size();
  told.num_roots =
      count_joints(skeleton, [](const Joint& joint) { return joint.parent == kNoParent; });
  told.num_tips = num_tips(skeleton);
  told.num_dofs = num_dofs(skeleton);
  told.num_columns = skeleton.coordinates.size();
  told.rotation_orders = rotation_orders_of(skeleton);
  told.num_joints_with_translations = count_joints(skeleton, has_translation);
  told.angle_unit = skeleton.angle_unit;
  told.metres_per_unit = skeleton.metres_per_unit;
  told.rest_extent = world_extent(skeleton, rest_clip(skeleton));
  return told;
}

EvidenceInfo evidence_of(Motion motion) {
  EvidenceInfo told;
  told.up = find_up_axis(motion);
  motion.skeleton.up = told.up.axis;  // what follows need not find it again
  told.facing = find_facing(motion, told.up.axis);
  told.unit = find_length_unit(motion);
  return told;
}

TimeInfo info_of(const Timeline& timeline, std::size_t num_frames) {
  TimeInfo told;
  told.num_frames = num_frames;
  told.first_frame_number = timeline.first_frame_number;
  told.frame_time = frame_time(timeline);
  told.frame_rate = frame_rate(timeline);
  told.nominal_frame_rate = nominal_frame_rate(timeline);
  told.duration = duration(timeline, num_frames);
  told.has_own_times = has_own_times(timeline);
  return told;
}

BodyInfo info_of(const BodyMotion& body, const Document& document) {
  BodyInfo told;
  for (const Component& component : body.components) {
    told.components.push_back({component.kind, component.content,
                               component_type(document, component), component.num_parts,
                               component.is_root_relative,
                               info_of(component.timeline, component.num_frames)});
  }
  if (const Component* main = main_component(body)) {
    told.time = info_of(main->timeline, main->num_frames);
  }
  return told;
}

std::vector<BlockCount> counts_by_kind(const PoseFlow& flow) {
  std::vector<BlockCount> counts(std::variant_size_v<BlockBody>);
  for (const Block& block : flow.blocks) {
    BlockCount& count = counts[block.body.index()];
    count.kind = body_name(block);
    ++count.num_blocks;
  }
  std::erase_if(counts, [](const BlockCount& count) { return count.num_blocks == 0; });
  return counts;
}

SliderInfo info_of(const RobotProject* project, std::size_t number, std::int16_t word) {
  SliderInfo told{number, fmt::format("s{}", number), word, std::nullopt};
  if (project == nullptr || number >= project->sliders.size()) return told;
  const Slider& slider = project->sliders[number];
  if (!slider.name.empty()) told.name = slider.name;
  if (slider.units_per_degree > 0) told.degrees = word / slider.units_per_degree;
  return told;
}

PoseInfo info_of(const PoseBlock& pose, const RobotProject* project) {
  PoseInfo told;
  told.ticks = pose.ticks;
  told.sound = pose.sound;
  for (std::size_t s = 0; s < pose.words.size(); ++s) {
    const SliderWord& word = pose.words[s];
    if (word.is_enabled) told.sliders.push_back(info_of(project, s, word.value));
  }
  return told;
}

FlowInfo info_of(const PoseFlow& flow, const InfoOptions& options) {
  FlowInfo told{flow.format, flow.num_sliders, flow.blocks.size(), counts_by_kind(flow), {}};
  for (std::size_t b = 0; options.poses && b < flow.blocks.size(); ++b) {
    const PoseBlock* const pose = std::get_if<PoseBlock>(&flow.blocks[b].body);
    if (pose == nullptr) continue;
    PoseInfo& last = told.poses.emplace_back(info_of(*pose, options.project));
    last.block = b;
    last.name = flow.blocks[b].name;
  }
  return told;
}

}  // namespace

Info info(const Document& document, const InfoOptions& options) {
  Info told;
  told.format = document.format;
  told.kind = kind_name(document);
  told.facts = facts_of(document);
  if (has_skeleton(document)) {
    told.skeleton = info_of(skeleton_of(document));
    told.evidence = evidence_of(still_or_moving(document));
  }
  if (const Motion* motion = std::get_if<Motion>(&document.content)) {
    told.motion = {info_of(motion->clip.timeline, motion->clip.num_frames),
                   world_extent(motion->skeleton, motion->clip)};
  }
  if (const BodyMotion* body = std::get_if<BodyMotion>(&document.content)) {
    told.body = info_of(*body, document);
  }
  if (const PoseFlow* flow = std::get_if<PoseFlow>(&document.content)) {
    told.flow = info_of(*flow, options);
  }
  return told;
}

}  // namespace kinefile
