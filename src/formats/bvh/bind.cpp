// SPDX-License-Identifier: MIT
#include "formats/bvh/bind.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace kinefile::bvh {
namespace {

/// The degree of freedom of a channel, for the joint that it belongs to.
DegreeOfFreedom dof_of_channel(const Channel& channel, std::size_t column) {
  DegreeOfFreedom dof;
  dof.axis = Vec3::Unit(static_cast<Eigen::Index>(channel.axis));
  dof.coordinate = column;
  if (channel.kind == ChannelKind::Position) dof.kind = DofKind::Translation;
  if (channel.kind == ChannelKind::Scale) {
    dof.kind = DofKind::TailScale;
    dof.rest = 1;
  }
  return dof;
}

/// Replaces the components of a joint's offset by its position channels. Where the component is
/// zero, adding gives the same, and this keeps the sign of the zero.
void replace_offset(Joint& joint, PositionMode mode) {
  std::array<bool, 3> is_replaced{};
  for (DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind != DofKind::Translation) continue;
    Eigen::Index axis = 0;
    dof.axis.maxCoeff(&axis);
    double& component = joint.offset[axis];
    const bool is_first = !std::exchange(is_replaced[static_cast<std::size_t>(axis)], true);
    if (!is_first || (mode == PositionMode::Add && component != 0)) continue;
    dof.rest = std::exchange(component, 0.0);
  }
}

Joint bind_node(const Node& node, std::size_t first_column, PositionMode mode) {
  Joint joint;
  joint.name = node.name;
  joint.parent = node.parent;
  joint.offset = vector_of(node.offset);
  for (std::size_t c = 0; c < node.channels.size(); ++c) {
    if (node.channels[c].kind == ChannelKind::Unknown) continue;
    joint.dofs.push_back(dof_of_channel(node.channels[c], first_column + c));
  }
  // Every program translates before it rotates, whatever the order of the channels.
  std::stable_partition(joint.dofs.begin(), joint.dofs.end(), [](const DegreeOfFreedom& dof) {
    return dof.kind == DofKind::Translation;
  });
  replace_offset(joint, mode);
  for (const EndSite& site : node.end_sites) {
    joint.tips.push_back({std::string(site.name), vector_of(site.offset)});
  }
  return joint;
}

}  // namespace

Motion bind(File&& file, const PositionModes& modes) {
  Motion motion;
  std::size_t column = 0;
  for (std::size_t n = 0; n < file.nodes.size(); ++n) {
    const Node& node = file.nodes[n];
    motion.skeleton.joints.push_back(bind_node(node, column, modes[n]));
    for (const Channel& channel : node.channels) {
      motion.skeleton.coordinates.push_back({n, spelling(channel)});
    }
    column += node.channels.size();
  }
  motion.clip.num_frames = file.num_frames;
  motion.clip.num_coordinates = column;
  motion.clip.values = std::move(file.values);
  motion.clip.timeline.given = FrameTime{file.frame_time};
  return motion;
}

}  // namespace kinefile::bvh
