// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "kinefile/shape.hpp"
#include "kinematics/column_range.hpp"
#include "kinematics/joint_columns.hpp"

// What `with_channels` makes of each joint's channels.

namespace kinefile::shape {

/// A column of the new clip.
struct ColumnSource {
  enum class From { Column, Constant, Angle, Position } from = From::Column;
  std::size_t column = 0;  ///< of the old clip
  double constant = 0;
  std::size_t component = 0;  ///< which of the joint's three new angles, or positions
};

/// How one joint's channels are made from its old ones.
struct JointChange {
  std::vector<ColumnSource> columns;
  std::vector<std::string> channels;
  std::vector<DegreeOfFreedom> dofs;  ///< their coordinates are indices of `columns`
  Vec3 offset = Vec3::Zero();
  bool loses_noise = false;  ///< of positions
  bool has_new_angles = false;
  std::vector<DegreeOfFreedom> old_rotations;
  std::vector<Translation> old_translations;  ///< if there are new positions; the axes are in the
                                              ///< joint's frame
  EulerAxes axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
};

/// What a change of channels is decided from.
struct ChannelContext {
  const Skeleton& skeleton;
  const ColumnRanges& ranges;  ///< of the columns in `deciding_columns`
  const ChannelOptions& options;
  Diagnostics& diagnostics;
  PositionChannels positions = PositionChannels::AsIs;
  bool adds_positions = false;
  double size = 0;  ///< of the skeleton
  std::vector<std::vector<std::size_t>> columns_of_joint = {};
  std::vector<std::size_t> num_readers = {};  ///< of every column
};

/// The columns whose numbers decide about the change: those of positions that are dropped.
std::vector<std::size_t> deciding_columns(const Skeleton& skeleton, PositionChannels all);

/// Plans the new channels of a joint, which does not move freely.
/// \errors EDT001 (DataLoss) if positions that change are dropped, and not lenient
Result<JointChange> plan_change(const ChannelContext& context, std::size_t joint_index);

/// Transforms a vector from the parent's frame to the frame of a joint's translations. It keeps its
/// bits if the joint has no rest rotation.
Vec3 in_rest_frame(const Joint& joint, const Vec3& v);

}  // namespace kinefile::shape
