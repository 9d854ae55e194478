// SPDX-License-Identifier: MIT
#include "shape/channel_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinefile/joint_rotation.hpp"
#include "kinefile/kinematics.hpp"

namespace kinefile::shape {
namespace {

/// The axis of x, y, z that a degree of freedom is about or along.
std::optional<std::size_t> axis_of(const DegreeOfFreedom& dof) { return coordinate_axis(dof.axis); }

/// Whether the axes of the rotations are a subsequence of an order.
bool is_in_order(const std::vector<DegreeOfFreedom>& rotations, const RotationOrder& order) {
  std::size_t next = 0;
  for (const DegreeOfFreedom& dof : rotations) {
    while (next < 3 && order[next] != *axis_of(dof)) ++next;
    if (next == 3) return false;
    ++next;
  }
  return true;
}

/// The opposite of `in_rest_frame`.
Vec3 from_rest_frame(const Joint& joint, const Vec3& v) {
  const bool is_turned = !joint.rest_rotation.isApprox(Quat::Identity(), 0);
  return is_turned ? joint.rest_rotation * v : v;
}

void add_column(JointChange& change, ColumnSource column, std::string channel,
                std::optional<DegreeOfFreedom> dof) {
  if (dof) {
    dof->coordinate = change.columns.size();
    change.dofs.push_back(*dof);
  }
  change.columns.push_back(column);
  change.channels.push_back(std::move(channel));
}

/// The error that a joint moves along one of its translations.
Error position_loss(const ChannelContext& context, const Joint& joint, const DegreeOfFreedom& dof) {
  return make_error(ErrorKind::DataLoss, "EDT001",
                    fmt::format("joint '{}' moves along {} by up to {:.6g}, which is lost without "
                                "its position channels",
                                joint.name, context.skeleton.coordinates[dof.coordinate].channel,
                                farthest_from(context.ranges.at(dof.coordinate), dof.rest)));
}

/// Adds position channels to the offset, if they are constant but for noise.
Result<void> drop_positions(const ChannelContext& context, const Joint& joint,
                            JointChange& change) {
  const double noise = noise_of_place(joint, context.size);
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind != DofKind::Translation) continue;
    auto settled = settled_number(context.ranges.at(dof.coordinate), dof.rest, noise);
    if (!settled) {
      Error error = position_loss(context, joint, dof);
      if (!context.options.lenient) return fail(std::move(error));
      error.severity = Severity::Warning;
      error.message += "; its rest position is taken";
      context.diagnostics.add(std::move(error));
      settled = SettledNumber{dof.rest, 0};
    }
    change.loses_noise |= settled->loss > 0;
    change.offset += from_rest_frame(joint, settled->number * dof.axis);
  }
  return {};
}

/// Keeps the joint's position channels and adds the missing ones.
void complete_positions(const ChannelContext& context, const Joint& joint, JointChange& change) {
  Vec3 offset = in_rest_frame(joint, joint.offset);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const std::string channel = channel_name(DofKind::Translation, k);
    bool is_there = false;
    for (const DegreeOfFreedom& dof : joint.dofs) {
      if (dof.kind != DofKind::Translation || axis_of(dof) != k) continue;
      add_column(change, {ColumnSource::From::Column, dof.coordinate, 0, 0}, channel, dof);
      is_there = true;
    }
    if (is_there) continue;
    const double value = context.adds_positions ? 0 : std::exchange(offset[axis], 0.0);
    if (value != 0) change.offset = from_rest_frame(joint, offset);
    add_column(change, {ColumnSource::From::Constant, 0, value, 0}, channel,
               DegreeOfFreedom{DofKind::Translation, Vec3::Unit(axis), 0, value});
  }
}

/// Whether a degree of freedom has its own column, and the axis x, y or z.
bool is_plain(const ChannelContext& context, std::size_t joint_index, const DegreeOfFreedom& dof) {
  const bool is_own = context.num_readers[dof.coordinate] == 1 &&
                      context.skeleton.coordinates[dof.coordinate].joint == joint_index;
  return is_own && axis_of(dof).has_value();
}

bool are_plain(const ChannelContext& context, std::size_t joint_index, DofKind kind) {
  const std::vector<DegreeOfFreedom>& dofs = context.skeleton.joints[joint_index].dofs;
  return std::all_of(dofs.begin(), dofs.end(), [&](const DegreeOfFreedom& dof) {
    return dof.kind != kind || is_plain(context, joint_index, dof);
  });
}

/// Whether a joint's translations are added to its offset.
bool adds_to_offset(const Joint& joint) {
  return std::any_of(joint.dofs.begin(), joint.dofs.end(), [&joint](const DegreeOfFreedom& dof) {
    return dof.kind == DofKind::Translation &&
           in_rest_frame(joint, joint.offset).dot(dof.axis) != 0;
  });
}

/// Whether a joint has two translations along one axis.
bool repeats_a_direction(const Joint& joint) {
  const std::vector<Translation> translations = translations_of(joint);
  for (std::size_t a = 0; a < translations.size(); ++a) {
    for (std::size_t b = a + 1; b < translations.size(); ++b) {
      if (translations[a].dof.axis == translations[b].dof.axis) return true;
    }
  }
  return false;
}

/// Whether a joint has two rotations about one axis, as in the order ZXZ.
bool repeats_a_rotation(const Joint& joint) {
  const auto rotations = rotations_of(joint);
  for (std::size_t a = 0; a < rotations.size(); ++a) {
    for (std::size_t b = a + 1; b < rotations.size(); ++b) {
      if (rotations[a].axis.cross(rotations[b].axis).norm() < 1e-9) return true;
    }
  }
  return false;
}

/// Gives a joint positions along x, y and z instead of those along other axes, or from shared
/// columns.
void replace_positions(const ChannelContext& context, const Joint& joint, JointChange& change) {
  Vec3 rest = Vec3::Zero();
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind != DofKind::Translation) continue;
    change.old_translations.push_back({dof.axis, dof});
    rest += dof.rest * dof.axis;
  }
  if (!context.adds_positions) {
    // Positions that replace the offset have the same origin as the offset.
    rest += in_rest_frame(joint, std::exchange(change.offset, Vec3::Zero()));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    add_column(change, {ColumnSource::From::Position, 0, 0, k},
               channel_name(DofKind::Translation, k),
               DegreeOfFreedom{DofKind::Translation, Vec3::Unit(axis), 0, rest[axis]});
  }
}

/// The angles about new axes of the joint's rotation in the rest pose.
Vec3 rest_angles(const std::vector<DegreeOfFreedom>& rotations, const EulerAxes& axes,
                 AngleUnit unit) {
  Mat3 rotation = Mat3::Identity();
  for (const DegreeOfFreedom& dof : rotations) {
    rotation = rotation * Eigen::AngleAxisd(dof.rest * radians_per(unit), dof.axis);
  }
  return euler_angles(rotation, axes) / radians_per(unit);
}

/// Adds three rotations: the joint's own if they are in order, otherwise angles that are computed
/// later.
void add_rotations(const Joint& joint, const RotationOrder& order, bool are_kept, AngleUnit unit,
                   JointChange& change) {
  change.old_rotations = rotations_of(joint);
  const bool is_kept = are_kept && is_in_order(change.old_rotations, order);
  change.has_new_angles = !is_kept;
  for (std::size_t k = 0; k < 3; ++k) {
    change.axes[k] = Vec3::Unit(static_cast<Eigen::Index>(order[k]));
  }
  const Vec3 rest =
      is_kept ? Vec3(Vec3::Zero()) : rest_angles(change.old_rotations, change.axes, unit);
  std::size_t next_old = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    DegreeOfFreedom dof{DofKind::Rotation, change.axes[k], 0, rest[static_cast<Eigen::Index>(k)]};
    ColumnSource column{ColumnSource::From::Angle, 0, 0, k};
    if (is_kept) column.from = ColumnSource::From::Constant;
    if (is_kept && next_old < change.old_rotations.size() &&
        axis_of(change.old_rotations[next_old]) == order[k]) {
      dof = change.old_rotations[next_old++];  // keeps its rest value and its limits
      column = {ColumnSource::From::Column, dof.coordinate, 0, 0};
    }
    add_column(change, column, channel_name(DofKind::Rotation, order[k]), dof);
  }
}

bool is_tail(const DegreeOfFreedom& dof) {
  return dof.kind == DofKind::TailTranslation || dof.kind == DofKind::TailScale;
}

/// Keeps columns of a joint: those that its kept degrees of freedom read, and those that none
/// reads. A column of another joint that one of these reads is copied for this joint.
/// \param is_kept   whether a degree of freedom is one of these
template <class IsKept>
void keep_columns(const ChannelContext& context, std::size_t joint_index, const IsKept& is_kept,
                  JointChange& change) {
  const Skeleton& skeleton = context.skeleton;
  const std::vector<DegreeOfFreedom>& dofs = skeleton.joints[joint_index].dofs;
  std::vector<std::size_t> columns;
  for (const std::size_t c : context.columns_of_joint[joint_index]) {
    const bool is_read = std::any_of(dofs.begin(), dofs.end(), [&](const DegreeOfFreedom& dof) {
      return dof.coordinate == c && is_kept(dof);
    });
    if (is_read || context.num_readers[c] == 0) columns.push_back(c);
  }
  for (const DegreeOfFreedom& dof : dofs) {
    const bool is_there =
        std::find(columns.begin(), columns.end(), dof.coordinate) != columns.end();
    if (is_kept(dof) && !is_there) columns.push_back(dof.coordinate);
  }
  const std::size_t first = change.columns.size();
  for (const std::size_t c : columns) {
    add_column(change, {ColumnSource::From::Column, c, 0, 0}, skeleton.coordinates[c].channel, {});
  }
  for (DegreeOfFreedom dof : dofs) {
    if (!is_kept(dof)) continue;
    const auto at = std::find(columns.begin(), columns.end(), dof.coordinate);
    dof.coordinate = first + static_cast<std::size_t>(at - columns.begin());
    change.dofs.push_back(dof);
  }
}

/// Keeps all columns of a joint unchanged.
JointChange unchanged(const ChannelContext& context, std::size_t joint_index) {
  JointChange change;
  change.offset = context.skeleton.joints[joint_index].offset;
  keep_columns(
      context, joint_index, [](const DegreeOfFreedom&) { return true; }, change);
  return change;
}

/// An order of three rotations that contains the joint's own and can represent every rotation, if
/// there is one. Axes that the joint lacks are where they are in `usual`, otherwise innermost.
std::optional<RotationOrder> own_order(const Joint& joint, const RotationOrder& usual) {
  const auto rotations = rotations_of(joint);
  std::vector<std::size_t> axes;
  for (const DegreeOfFreedom& dof : rotations) {
    if (!axis_of(dof)) return std::nullopt;
    axes.push_back(*axis_of(dof));
  }
  if (axes.size() < 3 && is_in_order(rotations, usual)) return usual;
  for (std::size_t axis = 0; axis < 3 && rotations.size() < 3; ++axis) {
    if (std::find(axes.begin(), axes.end(), axis) == axes.end()) axes.push_back(axis);
  }
  if (axes.size() != 3 || axes[0] == axes[1] || axes[1] == axes[2]) return std::nullopt;
  return RotationOrder{axes[0], axes[1], axes[2]};
}

/// The choice for a single joint that a choice for all joints means.
PositionChannels positions_for(const Joint& joint, PositionChannels all) {
  if (all != PositionChannels::RootAndOwn) return all;
  const bool is_root = joint.parent == kNoParent;
  if (is_root || !translations_of(joint).empty()) return PositionChannels::All;
  return rotations_of(joint).empty() ? PositionChannels::AsIs : PositionChannels::Root;
}

/// Whether a joint has position channels after the change.
bool keeps_positions(const Joint& joint, PositionChannels all) {
  const PositionChannels positions = positions_for(joint, all);
  return positions != PositionChannels::Root || joint.parent == kNoParent;
}

}  // namespace

Vec3 in_rest_frame(const Joint& joint, const Vec3& v) {
  const bool is_turned = !joint.rest_rotation.isApprox(Quat::Identity(), 0);
  return is_turned ? joint.rest_rotation.conjugate() * v : v;
}

bool repeats_an_axis(const Joint& joint) {
  return repeats_a_rotation(joint) || repeats_a_direction(joint);
}

std::vector<std::size_t> deciding_columns(const Skeleton& skeleton, PositionChannels all) {
  std::vector<std::size_t> columns;
  for (const Joint& joint : skeleton.joints) {
    if (keeps_positions(joint, all)) continue;
    for (const DegreeOfFreedom& dof : joint.dofs) {
      if (dof.kind == DofKind::Translation) columns.push_back(dof.coordinate);
    }
  }
  return columns;
}

Result<JointChange> plan_change(const ChannelContext& context, std::size_t joint_index) {
  const Joint& joint = context.skeleton.joints[joint_index];
  const PositionChannels positions = positions_for(joint, context.positions);
  const bool is_as_is = positions == PositionChannels::AsIs;
  const bool has_positions = positions == PositionChannels::All || joint.parent == kNoParent;
  const bool is_refused = context.options.distinct_axes && repeats_a_rotation(joint);
  const RotationOrder& usual = context.options.usual_order;
  const auto own = is_refused ? std::nullopt : own_order(joint, usual);
  const RotationOrder order = context.options.order.value_or(own.value_or(usual));
  const auto rotations = rotations_of(joint);
  const bool has_plain_rotations = are_plain(context, joint_index, DofKind::Rotation);
  const bool has_plain_positions =
      are_plain(context, joint_index, DofKind::Translation) &&
      !(context.options.replaces_offsets && adds_to_offset(joint)) &&
      ((is_as_is && !context.options.distinct_axes) || !repeats_a_direction(joint));
  const bool keeps_rotations =
      has_plain_rotations && !is_refused &&
      (rotations.size() <= 1 || !context.options.order || is_in_order(rotations, order));
  if (is_as_is && keeps_rotations && has_plain_positions) return unchanged(context, joint_index);
  JointChange change;
  change.offset = joint.offset;
  if (!has_plain_positions && (is_as_is || has_positions)) {
    replace_positions(context, joint, change);
  } else if (is_as_is) {
    for (const DegreeOfFreedom& dof : joint.dofs) {
      if (dof.kind != DofKind::Translation) continue;
      add_column(change, {ColumnSource::From::Column, dof.coordinate, 0, 0},
                 channel_name(DofKind::Translation, *axis_of(dof)), dof);
    }
  } else if (has_positions) {
    complete_positions(context, joint, change);
  } else if (auto dropped = drop_positions(context, joint, change); !dropped) {
    return fail(std::move(dropped.error()));
  }
  if (is_as_is && rotations.empty()) {
    keep_columns(context, joint_index, is_tail, change);
    return change;
  }
  add_rotations(joint, order, has_plain_rotations && !is_refused, context.skeleton.angle_unit,
                change);
  keep_columns(context, joint_index, is_tail, change);
  return change;
}

}  // namespace kinefile::shape
