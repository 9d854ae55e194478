// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "base/parallel.hpp"
#include "kinefile/compare.hpp"
#include "kinefile/kinematics.hpp"
#include "kinematics/rotation_batches.hpp"
#include "shape/channel_plan.hpp"

namespace kinefile::shape {
namespace {

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

/// Fills the columns of one joint, frames after frames.
struct ColumnFiller {
  const JointChange* change = nullptr;
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
  const std::vector<ColumnSource>& columns = filler.change->columns;
  for (std::size_t i = 0; i < frames.count; ++i) {
    const std::size_t f = frames.first + i;
    const Vec3 position =
        position_in_row(filler.base, filler.change->old_translations, source.row(f));
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
  for (std::size_t c = 0; c < filler.change->columns.size(); ++c) {
    const ColumnSource& column = filler.change->columns[c];
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
  if (!filler.change->old_translations.empty()) fill_positions(source, filler, frames, out);
}

/// Fills the columns of some joints, a block of frames after the other.
void fill_columns(const Motion& source, std::span<ColumnFiller> fillers, const Rows& out) {
  simd::Quaternions rotations;
  simd::Angles angles;
  for (const FrameBatch& frames : batches_of(source.clip.num_frames)) {
    for (ColumnFiller& filler : fillers) {
      if (filler.change->columns.empty()) continue;
      if (filler.change->has_new_angles) {
        filler.reader.read(source.clip, frames, rotations);
        filler.finder.find(rotations, frames.count, angles);
      }
      fill_rows(source.clip, filler, frames, angles, out);
    }
  }
}

/// Gives other channels to a motion without gains and shifts, whose rotations are angles.
Result<Motion> with_channels_of_angles(const Motion& motion, const ChannelOptions& options,
                                       Diagnostics& diagnostics) {
  const ChannelContext context{
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
                       RotationReader(changes[j].old_rotations, motion.skeleton.angle_unit),
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
  const RotationOrder order = options.order.value_or(options.usual_order);
  return with_channels_of_angles(with_angles(with_plain_values(motion), order), options,
                                 diagnostics);
}

}  // namespace kinefile::shape
