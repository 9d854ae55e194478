// SPDX-License-Identifier: MIT
#include "formats/bvh/bind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "formats/bvh/codes.hpp"

namespace kinefile::bvh {
namespace {

Vec3 vector_of(const std::array<double, 3>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

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

/// The median over the first frames of a channel's absolute distance from a value.
double median_distance(const File& file, std::size_t column, double from) {
  constexpr std::size_t kFrames = 10;
  std::vector<double> distances;
  for (std::size_t f = 0; f < std::min(kFrames, file.num_frames); ++f) {
    const double distance = std::abs(file.values[f * file.num_columns + column] - from);
    if (std::isfinite(distance)) distances.push_back(distance);
  }
  if (distances.empty()) return 0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

/// A guess from the largest component of a node's OFFSET, if it has a position channel: values
/// around zero are meant to be added, values around OFFSET replace it. The other components give no
/// information, because a walk leaves its start.
std::optional<PositionGuess> guess_from_node(const File& file, const Node& node,
                                             std::size_t first_column) {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::abs(node.offset[k]) > std::abs(node.offset[axis])) axis = k;
  }
  const auto found =
      std::find_if(node.channels.begin(), node.channels.end(), [axis](const Channel& channel) {
        return channel.kind == ChannelKind::Position && channel.axis == axis;
      });
  if (node.offset[axis] == 0 || found == node.channels.end()) return std::nullopt;
  const std::size_t column = first_column + static_cast<std::size_t>(found - node.channels.begin());
  const double offset = node.offset[axis];
  const double from_zero = median_distance(file, column, 0);
  const bool is_added = from_zero < std::abs(offset) / 4;
  return PositionGuess{is_added ? PositionMode::Add : PositionMode::Replace, true,
                       fmt::format("the {} of '{}' starts {} from zero, and its OFFSET is {}",
                                   spelling(*found), node.name, from_zero, offset)};
}

}  // namespace

PositionGuess guess_positions(const File& file) {
  std::size_t column = 0;
  for (const Node& node : file.nodes) {
    if (file.num_frames > 0) {
      if (const auto guess = guess_from_node(file, node, column)) return *guess;
    }
    column += node.channels.size();
  }
  return {PositionMode::Replace, false, "no OFFSET tells"};
}

Motion bind(File&& file, PositionMode mode) {
  Motion motion;
  std::size_t column = 0;
  for (std::size_t n = 0; n < file.nodes.size(); ++n) {
    const Node& node = file.nodes[n];
    motion.skeleton.joints.push_back(bind_node(node, column, mode));
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
