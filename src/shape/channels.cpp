// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "base/parallel.hpp"
#include "kinefile/compare.hpp"
#include "kinefile/joint_rotation.hpp"
#include "kinefile/kinematics.hpp"
#include "kinefile/shape.hpp"
#include "kinematics/joint_columns.hpp"
#include "kinematics/rotation_batches.hpp"

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

struct Context {
  const Motion& motion;
  const ChannelOptions& options;
  Diagnostics& diagnostics;
  PositionChannels positions = PositionChannels::AsIs;
  bool adds_positions = false;
  double size = 0;  ///< of the skeleton
  std::vector<std::vector<std::size_t>> columns_of_joint = {};
  std::vector<std::size_t> num_readers = {};  ///< of every column
};

void add_column(JointChange& change, ColumnSource column, std::string channel,
                std::optional<DegreeOfFreedom> dof) {
  if (dof) {
    dof->coordinate = change.columns.size();
    change.dofs.push_back(*dof);
  }
  change.columns.push_back(column);
  change.channels.push_back(std::move(channel));
}

/// Transforms a vector from the parent's frame to the frame of a joint's translations, and back. It
/// keeps its bits if the joint has no rest rotation.
Vec3 in_rest_frame(const Joint& joint, const Vec3& v) {
  const bool is_turned = !joint.rest_rotation.isApprox(Quat::Identity(), 0);
  return is_turned ? joint.rest_rotation.conjugate() * v : v;
}
Vec3 from_rest_frame(const Joint& joint, const Vec3& v) {
  const bool is_turned = !joint.rest_rotation.isApprox(Quat::Identity(), 0);
  return is_turned ? joint.rest_rotation * v : v;
}

/// The error that a joint moves along one of its translations.
Error position_loss(const Context& context, const Joint& joint, const DegreeOfFreedom& dof) {
  double most = 0;
  for (std::size_t f = 0; f < context.motion.clip.num_frames; ++f) {
    most = std::fmax(most, std::abs(context.motion.clip.row(f)[dof.coordinate] - dof.rest));
  }
  return make_error(
      ErrorKind::DataLoss, "EDT001",
      fmt::format("joint '{}' moves along {} by up to {:.6g}, which is lost without "
                  "its position channels",
                  joint.name, context.motion.skeleton.coordinates[dof.coordinate].channel, most));
}

/// Adds position channels to the offset, if they are constant but for noise.
Result<void> drop_positions(const Context& context, const Joint& joint, JointChange& change) {
  const double noise = noise_of_place(joint, context.size);
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind != DofKind::Translation) continue;
    auto settled = settled_number(context.motion.clip, dof.coordinate, dof.rest, noise);
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

/// Reports what is lost with the noise of positions, if any is.
void note_lost_noise(const Motion& motion, const std::vector<JointChange>& changes,
                     const Motion& result, Diagnostics& diagnostics) {
  const auto count = std::count_if(changes.begin(), changes.end(),
                                   [](const JointChange& change) { return change.loses_noise; });
  if (count == 0) return;
  const LargestDifference most = compare_motions(motion, result).distance;
  diagnostics.add(
      Severity::Note, "EDT013",
      fmt::format("the positions of {} joint{} that stay but for noise are lost: {:.2g} "
                  "at the most, at '{}' in frame {}",
                  count, count == 1 ? "" : "s", most.value, most.joint, most.frame));
}

/// Keeps the joint's position channels and adds the missing ones.
void complete_positions(const Context& context, const Joint& joint, JointChange& change) {
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
bool is_plain(const Context& context, std::size_t joint_index, const DegreeOfFreedom& dof) {
  const bool is_own = context.num_readers[dof.coordinate] == 1 &&
                      context.motion.skeleton.coordinates[dof.coordinate].joint == joint_index;
  return is_own && axis_of(dof).has_value();
}

bool are_plain(const Context& context, std::size_t joint_index, DofKind kind) {
  const std::vector<DegreeOfFreedom>& dofs = context.motion.skeleton.joints[joint_index].dofs;
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
void replace_positions(const Context& context, const Joint& joint, JointChange& change) {
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
void keep_columns(const Context& context, std::size_t joint_index, const IsKept& is_kept,
                  JointChange& change) {
  const Skeleton& skeleton = context.motion.skeleton;
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
JointChange unchanged(const Context& context, std::size_t joint_index) {
  JointChange change;
  change.offset = context.motion.skeleton.joints[joint_index].offset;
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

Result<JointChange> plan_change(const Context& context, std::size_t joint_index) {
  const Joint& joint = context.motion.skeleton.joints[joint_index];
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
  add_rotations(joint, order, has_plain_rotations && !is_refused,
                context.motion.skeleton.angle_unit, change);
  keep_columns(context, joint_index, is_tail, change);
  return change;
}

/// Fills the columns of one joint, frames after frames.
struct ColumnFiller {
  const JointChange* change = nullptr;
  std::size_t first_column = 0;
  Vec3 base = Vec3::Zero();  ///< the part of the joint's offset that its positions now contain
  rotation::AngleFinder finder;
};

/// Fills a joint's columns in some frames.
/// \param angles  the joint's new angles, if it has any
void fill_rows(const Clip& source, const ColumnFiller& filler, const FrameBatch& frames,
               const simd::Angles& angles, const Rows& out) {
  for (std::size_t i = 0; i < frames.count; ++i) {
    const auto row = source.row(frames.first + i);
    double* value = &out[frames.first + i][filler.first_column];
    Vec3 position = Vec3::Zero();
    if (!filler.change->old_translations.empty()) {
      position = position_in_row(filler.base, filler.change->old_translations, row);
    }
    for (const ColumnSource& column : filler.change->columns) {
      switch (column.from) {
        case ColumnSource::From::Column:
          *value = row[column.column];
          break;
        case ColumnSource::From::Constant:
          *value = column.constant;
          break;
        case ColumnSource::From::Angle:
          *value = angles[column.component][i];
          break;
        case ColumnSource::From::Position:
          *value = position[static_cast<Eigen::Index>(column.component)];
          break;
      }
      ++value;
    }
  }
}

/// Fills the columns of some joints, a block of frames after the other.
void fill_columns(const Motion& source, std::span<ColumnFiller> fillers, const Rows& out) {
  const AngleUnit unit = source.skeleton.angle_unit;
  simd::Quaternions rotations;
  simd::Angles angles;
  for (const FrameBatch& frames : batches_of(source.clip.num_frames)) {
    for (ColumnFiller& filler : fillers) {
      if (filler.change->columns.empty()) continue;
      if (filler.change->has_new_angles) {
        rotations_in_rows(filler.change->old_rotations, source.clip, frames, unit, rotations);
        filler.finder.find(rotations, frames.count, angles);
      }
      fill_rows(source.clip, filler, frames, angles, out);
    }
  }
}

}  // namespace

bool repeats_an_axis(const Joint& joint) {
  return repeats_a_rotation(joint) || repeats_a_direction(joint);
}

std::optional<RotationOrder> parse_rotation_order(std::string_view text) {
  if (text.size() != 3) return std::nullopt;
  RotationOrder order{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t axis = std::string_view("XYZxyz").find(text[k]);
    if (axis == std::string_view::npos) return std::nullopt;
    order[k] = axis % 3;
  }
  if (order[0] == order[1] || order[1] == order[2]) return std::nullopt;
  return order;
}

namespace {

/// Gives other channels to a motion without gains and shifts, whose rotations are angles.
Result<Motion> with_channels_of_angles(const Motion& motion, const ChannelOptions& options,
                                       Diagnostics& diagnostics) {
  const Context context{
      motion,
      options,
      diagnostics,
      options.positions.value_or(options.usual_positions),
      !options.replaces_offsets && (options.adds_positions || adds_positions(motion.skeleton)),
      rest_size(motion.skeleton),
      columns_of_joints(motion.skeleton),
      num_readers_of_columns(motion.skeleton)};
  Motion result;
  result.skeleton = motion.skeleton;
  result.skeleton.coordinates.clear();
  std::vector<JointChange> changes;
  std::vector<std::size_t> first_columns;
  for (std::size_t j = 0; j < motion.skeleton.joints.size(); ++j) {
    if (moves_freely(motion.skeleton.joints[j])) {
      return fail(
          make_error(ErrorKind::Usage, "EDT002",
                     fmt::format("joint '{}' moves freely, so it cannot be given other channels",
                                 motion.skeleton.joints[j].name)));
    }
    auto change = plan_change(context, j);
    if (!change) return fail(std::move(change.error()));
    const std::size_t first = result.skeleton.coordinates.size();
    for (const std::string& channel : change->channels) {
      result.skeleton.coordinates.push_back({j, channel});
    }
    Joint& joint = result.skeleton.joints[j];
    joint.offset = change->offset;
    joint.dofs = change->dofs;
    for (DegreeOfFreedom& dof : joint.dofs) dof.coordinate += first;
    first_columns.push_back(first);
    changes.push_back(std::move(*change));
  }
  result.clip.timeline = motion.clip.timeline;
  result.clip.num_frames = motion.clip.num_frames;
  result.clip.num_coordinates = result.skeleton.coordinates.size();
  result.clip.values.resize(result.clip.num_frames * result.clip.num_coordinates);
  std::vector<ColumnFiller> fillers;
  for (std::size_t j = 0; j < changes.size(); ++j) {
    const Joint& joint = motion.skeleton.joints[j];
    const bool is_in_degrees = motion.skeleton.angle_unit == AngleUnit::Degrees;
    fillers.push_back({&changes[j], first_columns[j],
                       in_rest_frame(joint, joint.offset - changes[j].offset),
                       rotation::AngleFinder(changes[j].axes, is_in_degrees, Vec3::Zero())});
  }
  const Rows out = result.clip.mutate();
  const std::span<ColumnFiller> all = fillers;
  for_each_group(fillers.size(), out.values.size(), [&](std::size_t begin, std::size_t end) {
    fill_columns(motion, all.subspan(begin, end - begin), out);
  });
  note_lost_noise(motion, changes, result, diagnostics);
  return result;
}

}  // namespace

Result<Motion> with_channels(const Motion& motion, const ChannelOptions& options,
                             Diagnostics& diagnostics) {
  const RotationOrder order = options.order.value_or(options.usual_order);
  return with_channels_of_angles(with_angles(with_plain_values(motion), order), options,
                                 diagnostics);
}

}  // namespace kinefile::shape
