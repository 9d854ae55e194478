// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/bvh/bind.hpp"
#include "formats/bvh/codes.hpp"
#include "text/numbers.hpp"

namespace kinefile::bvh {
namespace {

Error not_expressible(const Joint& joint, std::string_view why) {
  return make_error(ErrorKind::DataLoss, code::kNotExpressible,
                    fmt::format("BVH cannot say that joint '{}' {}", joint.name, why));
}

ChannelKind channel_kind(DofKind kind) {
  switch (kind) {
    case DofKind::Rotation:
      return ChannelKind::Rotation;
    case DofKind::Translation:
      return ChannelKind::Position;
    case DofKind::TailScale:
      return ChannelKind::Scale;
    case DofKind::Free:
    case DofKind::Ball:
    case DofKind::RotationVector:
    case DofKind::TailTranslation:
      break;
  }
  return ChannelKind::Unknown;
}

/// A column that a degree of freedom reads, or an unread column whose word is kept.
struct Column {
  Channel channel;
  bool is_read = false;
};

/// Whether the name can be read back: one line, without braces and without blanks at its ends.
bool is_writable_name(std::string_view name) {
  return !name.empty() && name.find_first_of("\r\n{}") == std::string_view::npos &&
         !text::is_blank(name.front()) && !text::is_blank(name.back());
}

/// Whether an unread column is read back as unread: its word must not be a known channel or
/// keyword.
bool is_writable_unread(std::string_view word) {
  return channel_of_word(word).kind == ChannelKind::Unknown && !is_keyword(word) &&
         is_writable_name(word) && word.find_first_of(" \t\v\f") == std::string_view::npos;
}

std::optional<Error> name_columns(const Skeleton& skeleton, std::vector<Column>& columns) {
  for (std::size_t c = 0; c < columns.size(); ++c) {
    columns[c].channel.word = skeleton.coordinates[c].channel;
  }
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    if (!is_writable_name(joint.name)) {
      return not_expressible(joint, "has a name that is empty, spans lines or holds a brace");
    }
    for (const Tip& tip : joint.tips) {
      if (!tip.name.empty() && !is_writable_name(tip.name)) {
        return not_expressible(joint, "has a tip whose name spans lines or holds a brace");
      }
    }
    if (!joint.rest_rotation.isApprox(Quat::Identity(), 0)) {
      return not_expressible(joint, "is turned in its rest pose");
    }
    for (const DegreeOfFreedom& dof : joint.dofs) {
      const ChannelKind kind = channel_kind(dof.kind);
      const auto axis = coordinate_axis(dof.axis);
      Column& column = columns[dof.coordinate];
      if (kind == ChannelKind::Unknown) {
        const bool is_whole = num_coordinates(dof) > 1 && dof.kind != DofKind::Free;
        return not_expressible(joint,
                               is_whole ? "turns in any way" : "moves freely or along its bone");
      }
      if (!is_plain(dof)) return not_expressible(joint, "follows a column with a gain or a shift");
      if (!axis) return not_expressible(joint, "moves about an axis other than x, y and z");
      if (column.is_read || skeleton.coordinates[dof.coordinate].joint != j) {
        return not_expressible(joint, "shares a column with another movement");
      }
      column = {{kind, *axis, {}}, true};
    }
  }
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::string& word = skeleton.coordinates[c].channel;
    if (columns[c].is_read || is_writable_unread(word)) continue;
    return not_expressible(skeleton.joints[skeleton.coordinates[c].joint],
                           fmt::format("has a column '{}' that moves nothing", word));
  }
  return std::nullopt;
}

/// Joints depth first: the order of BVH's braces and of its columns.
std::vector<std::size_t> depth_first(const Skeleton& skeleton) {
  const auto children = children_of_joints(skeleton);
  std::vector<std::size_t> order;
  std::vector<std::size_t> waiting;
  for (std::size_t j = skeleton.joints.size(); j-- > 0;) {
    if (skeleton.joints[j].parent == kNoParent) waiting.push_back(j);
  }
  while (!waiting.empty()) {
    const std::size_t joint = waiting.back();
    waiting.pop_back();
    order.push_back(joint);
    waiting.insert(waiting.end(), children[joint].rbegin(), children[joint].rend());
  }
  return order;
}

/// The OFFSET of a joint: a component that a position channel replaces is that channel's rest.
std::array<double, 3> offset_of(const Joint& joint) {
  std::array<double, 3> offset = {joint.offset[0], joint.offset[1], joint.offset[2]};
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind != DofKind::Translation) continue;
    double& component = offset[*coordinate_axis(dof.axis)];
    if (component == 0) component = dof.rest;
  }
  return offset;
}

/// The columns of a joint in BVH's order, in which rotations are applied in column order: the
/// existing order, except for rotations whose columns have another order.
std::vector<std::size_t> ordered_columns(const Joint& joint, std::vector<std::size_t> columns) {
  std::vector<std::size_t> rotations;  // the columns of rotations, outermost first
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind == DofKind::Rotation) rotations.push_back(dof.coordinate);
  }
  auto next = rotations.begin();
  for (std::size_t& column : columns) {
    const bool turns = std::find(rotations.begin(), rotations.end(), column) != rotations.end();
    if (turns) column = *next++;
  }
  return columns;
}

}  // namespace

Result<Unbound> unbind(const Skeleton& skeleton) {
  if (skeleton.angle_unit != AngleUnit::Degrees && !skeleton.coordinates.empty()) {
    return fail(make_error(ErrorKind::DataLoss, code::kNotExpressible,
                           "BVH cannot say that angles are in radians"));
  }
  std::vector<Column> columns(skeleton.coordinates.size());
  if (auto error = name_columns(skeleton, columns)) return fail(std::move(*error));

  const auto columns_of_joint = columns_of_joints(skeleton);
  Unbound unbound;
  std::vector<std::size_t> node_of_joint(skeleton.joints.size());
  std::vector<std::size_t> depth(skeleton.joints.size());
  for (const std::size_t j : depth_first(skeleton)) {
    const Joint& joint = skeleton.joints[j];
    node_of_joint[j] = unbound.file.nodes.size();
    depth[j] = joint.parent == kNoParent ? 1 : depth[joint.parent] + 1;
    if (depth[j] >= kMaxDepth) {
      return fail(not_expressible(joint, "lies deeper than its readers go"));
    }
    Node node;
    node.name = joint.name;
    node.parent = joint.parent == kNoParent ? kNoParent : node_of_joint[joint.parent];
    node.offset = offset_of(joint);
    for (const Tip& tip : joint.tips) {
      node.end_sites.push_back({tip.name, {tip.offset[0], tip.offset[1], tip.offset[2]}});
    }
    for (const std::size_t c : ordered_columns(joint, columns_of_joint[j])) {
      node.channels.push_back(columns[c].channel);
      unbound.column_of.push_back(c);
    }
    unbound.file.nodes.push_back(std::move(node));
  }
  unbound.file.num_columns = columns.size();
  if (std::is_sorted(unbound.column_of.begin(), unbound.column_of.end())) unbound.column_of.clear();
  return unbound;
}

}  // namespace kinefile::bvh
