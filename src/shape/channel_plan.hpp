// SPDX-License-Identifier: MIT
// Which channels `with_channels` gives to a joint, and what they are made from.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kinefile/shape.hpp"
#include "kinematics/joint_columns.hpp"

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

/// What a plan relies on.
struct ChannelContext {
  const Motion& motion;
  const ChannelOptions& options;
  Diagnostics& diagnostics;
  PositionChannels positions = PositionChannels::AsIs;
  bool adds_positions = false;
  double size = 0;  ///< of the skeleton
  std::vector<std::vector<std::size_t>> columns_of_joint = {};
  std::vector<std::size_t> num_readers = {};  ///< of every column
};

/// Transforms a vector from the parent's frame to the frame of a joint's translations. It keeps its
/// bits if the joint has no rest rotation.
Vec3 in_rest_frame(const Joint& joint, const Vec3& v);

/// Plans one joint's channels.
/// \errors as for `with_channels`
Result<JointChange> plan_change(const ChannelContext& context, std::size_t joint_index);

}  // namespace kinefile::shape
