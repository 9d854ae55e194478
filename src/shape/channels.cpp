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
#include "shape/channel_plan.hpp"
#include "shape/frame_change.hpp"

namespace kinefile::shape {
namespace {

/// Fills the columns of one joint, frames after frames.
struct ColumnFiller {
  JointChange change;
  std::size_t first_column = 0;
  Vec3 base = Vec3::Zero();  ///< the part of the joint's offset that its positions now contain
  RotationReader reader;     ///< of the old angles
  rotation::AngleFinder finder;
};

/// Fills a column in some frames.
/// \param number  of the n-th of them
template <class Number>
void fill_column(const FrameBatch& frames, std::size_t column, const Number& number,
                 const Rows& out) {
  double* const to = out.values.data() + frames.first * out.width + column;
  for (std::size_t i = 0; i < frames.count; ++i) to[i * out.width] = number(i);
}

/// Fills those of a joint's columns that are new positions.
void fill_positions(const Clip& source, const ColumnFiller& filler, const FrameBatch& frames,
                    const Rows& out) {
  const std::vector<ColumnSource>& columns = filler.change.columns;
  for (std::size_t i = 0; i < frames.count; ++i) {
    const std::size_t f = frames.first + i;
    const Vec3 position =
        position_in_row(filler.base, filler.change.old_translations, source.row(f));
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (columns[c].from != ColumnSource::From::Position) continue;
      out[f][filler.first_column + c] = position[static_cast<Eigen::Index>(columns[c].component)];
    }
  }
}

/// Fills a joint's columns in some frames, column by column.
/// \param angles  the joint's new angles, if it has any
void fill_rows(const Clip& source, const ColumnFiller& filler, const FrameBatch& frames,
               const simd::Angles& angles, const Rows& out) {
  const double* const from = source.values.data() + frames.first * source.num_coordinates;
  for (std::size_t c = 0; c < filler.change.columns.size(); ++c) {
    const ColumnSource& column = filler.change.columns[c];
    const auto fill = [&](const auto& number) {
      fill_column(frames, filler.first_column + c, number, out);
    };
    switch (column.from) {
      case ColumnSource::From::Column:
        fill([&](std::size_t i) { return from[i * source.num_coordinates + column.column]; });
        break;
      case ColumnSource::From::Constant:
        fill([&](std::size_t) { return column.constant; });
        break;
      case ColumnSource::From::Angle:
        fill([&, numbers = angles[column.component].data()](std::size_t i) { return numbers[i]; });
        break;
      case ColumnSource::From::Position:
        break;
    }
  }
  if (!filler.change.old_translations.empty()) fill_positions(source, filler, frames, out);
}

/// Fills the columns of some joints, some frames after the other.
void fill_columns(const Clip& source, std::span<ColumnFiller> fillers, const Rows& out) {
  simd::Quaternions rotations;
  simd::Angles angles;
  for (const FrameBatch& frames : batches_of(source.num_frames)) {
    for (ColumnFiller& filler : fillers) {
      if (filler.change.columns.empty()) continue;
      if (filler.change.has_new_angles) {
        filler.reader.read(source, frames, rotations);
        filler.finder.find(rotations, frames.count, angles);
      }
      fill_rows(source, filler, frames, angles, out);
    }
  }
}

/// A change of channels, and whether noise of positions is lost by it.
struct ChannelChange {
  FrameChange frames;
  std::size_t num_noisy = 0;  ///< joints that lose noise
};

/// Puts a joint's new channels behind those of the joints before it.
ColumnFiller place_channels(const Skeleton& old, std::size_t joint_index, JointChange&& change,
                            Skeleton& skeleton) {
  const Joint& old_joint = old.joints[joint_index];
  const std::size_t first = skeleton.coordinates.size();
  for (const std::string& channel : change.channels) {
    skeleton.coordinates.push_back({joint_index, channel});
  }
  Joint& joint = skeleton.joints[joint_index];
  joint.offset = change.offset;
  joint.dofs = change.dofs;
  for (DegreeOfFreedom& dof : joint.dofs) dof.coordinate += first;
  const Vec3 base = in_rest_frame(old_joint, old_joint.offset - change.offset);
  const bool is_in_degrees = old.angle_unit == AngleUnit::Degrees;
  const rotation::AngleFinder finder(change.axes, is_in_degrees, Vec3::Zero());
  const RotationReader reader(change.old_rotations, old.angle_unit);
  return {std::move(change), first, base, reader, finder};
}

/// Plans other channels for a skeleton without gains and shifts, whose rotations are angles.
Result<ChannelChange> change_of(const ChannelContext& context) {
  const Skeleton& old = context.skeleton;
  ChannelChange change{{old}};
  Skeleton& skeleton = change.frames.skeleton;
  skeleton.coordinates.clear();
  std::vector<ColumnFiller> fillers;
  for (std::size_t j = 0; j < old.joints.size(); ++j) {
    if (moves_freely(old.joints[j])) {
      return fail(
          make_error(ErrorKind::Usage, "EDT002",
                     fmt::format("joint '{}' moves freely, so it cannot be given other channels",
                                 old.joints[j].name)));
    }
    auto planned = plan_change(context, j);
    if (!planned) return fail(std::move(planned.error()));
    change.num_noisy += planned->loses_noise ? 1 : 0;
    fillers.push_back(place_channels(old, j, *std::move(planned), skeleton));
  }
  change.frames.fill = [fillers = std::move(fillers)](const Clip& next, const Rows& out) mutable {
    const std::span<ColumnFiller> all = fillers;
    for_each_group(all.size(), out.values.size(), [&](std::size_t begin, std::size_t end) {
      fill_columns(next, all.subspan(begin, end - begin), out);
    });
  };
  return change;
}

/// Reports what is lost with the noise of positions.
/// \param frames  all frames of the motion with the old skeleton
Result<void> note_lost_noise(const Skeleton& old, EachBlock frames, ChannelChange change,
                             Diagnostics& diagnostics) {
  LargestDifference most;
  auto compared = frames([&](const FrameBlock& block) {
    const Motion before{old, clip_of(block, old.coordinates.size())};
    Motion after{change.frames.skeleton,
                 {block.num_frames, change.frames.skeleton.coordinates.size(), {}, {}}};
    after.clip.values.resize(after.clip.num_frames * after.clip.num_coordinates);
    change.frames.fill(before.clip, after.clip.mutate());
    LargestDifference found = compare_motions(before, after).distance;
    found.frame += block.first_frame;
    if (most.joint.empty() || found.value > most.value) most = std::move(found);
    return true;
  });
  if (!compared) return compared;
  diagnostics.add(
      Severity::Note, "EDT013",
      fmt::format("the positions of {} joint{} that stay but for noise are lost: {:.2g} "
                  "at the most, at '{}' in frame {}",
                  change.num_noisy, change.num_noisy == 1 ? "" : "s", most.value, most.joint,
                  most.frame));
  return {};
}

/// Gives other channels to a motion without gains and shifts, whose rotations are angles.
template <class AnyMotion>
Result<AnyMotion> with_channels_of_angles(const AnyMotion& motion, const ChannelOptions& options,
                                          Diagnostics& diagnostics) {
  const Skeleton& skeleton = skeleton_in(motion);
  const PositionChannels positions = options.positions.value_or(options.usual_positions);
  const auto frames = [&motion](UseBlock use) { return for_each_block_of(motion, use); };
  const auto ranges =
      ranges_of_columns(frames, skeleton.coordinates.size(), deciding_columns(skeleton, positions));
  if (!ranges) return fail(ranges.error());
  const ChannelContext context{
      skeleton,
      *ranges,
      options,
      diagnostics,
      positions,
      !options.replaces_offsets && (options.adds_positions || adds_positions(skeleton)),
      rest_size(skeleton),
      columns_of_joints(skeleton),
      num_readers_of_columns(skeleton)};
  auto change = change_of(context);
  if (!change) return fail(std::move(change.error()));
  if (change->num_noisy > 0) {
    auto noted = note_lost_noise(skeleton, frames, *change, diagnostics);
    if (!noted) return fail(std::move(noted.error()));
  }
  return changed(motion, std::move(change->frames));
}

template <class AnyMotion>
Result<AnyMotion> any_with_channels(const AnyMotion& motion, const ChannelOptions& options,
                                    Diagnostics& diagnostics) {
  const RotationOrder order = options.order.value_or(options.usual_order);
  return with_channels_of_angles(with_angles(with_plain_values(motion), order), options,
                                 diagnostics);
}

}  // namespace

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

Result<Motion> with_channels(const Motion& motion, const ChannelOptions& options,
                             Diagnostics& diagnostics) {
  return any_with_channels(motion, options, diagnostics);
}
Result<LongMotion> with_channels(const LongMotion& motion, const ChannelOptions& options,
                                 Diagnostics& diagnostics) {
  return any_with_channels(motion, options, diagnostics);
}

}  // namespace kinefile::shape
