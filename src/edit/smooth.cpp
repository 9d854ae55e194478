// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "base/parallel.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/joint_rotation.hpp"
#include "kinematics/joint_columns.hpp"
#include "kinematics/rotation_batches.hpp"
#include "math/turns.hpp"
#include "simd/angles.hpp"
#include "simd/low_pass.hpp"

namespace kinefile::edit {
namespace {

constexpr std::size_t kLanes = simd::LaneGroup::kSize;
constexpr double kNoDirection = 1e-6;  ///< the length of a smoothed quaternion that means nothing

/// A Butterworth filter of second order for both directions.
simd::LowPass low_pass_of(double cutoff_hz, double rate_hz) {
  constexpr std::size_t kMostPadding = 1'000'000;
  // Two passes together halve the power at (sqrt 2 - 1)^(1/4) of the cut-off of one pass. So the
  // cut-off of one pass is higher by that factor, in the frequencies of the bilinear transform.
  const double correction = std::pow(std::numbers::sqrt2 - 1, 0.25);
  const double w = std::tan(std::numbers::pi * cutoff_hz / rate_hz) / correction;
  const double scale = 1 / (1 + std::numbers::sqrt2 * w + w * w);
  const double periods = 2 * rate_hz / cutoff_hz;
  return {w * w * scale, 2 * (w * w - 1) * scale, (1 - std::numbers::sqrt2 * w + w * w) * scale,
          periods < kMostPadding ? static_cast<std::size_t>(periods) + 9 : kMostPadding};
}

/// Whether some columns have the same value in every frame.
bool is_constant(const Clip& clip, const std::vector<std::size_t>& columns) {
  return clip.num_frames == 0 ||
         std::all_of(columns.begin(), columns.end(), [&clip](std::size_t column) {
           return is_always(clip, column, clip.row(0)[column]);
         });
}

/// A column that is smoothed on its own.
struct Column {
  std::size_t index = 0;
  double turn = 0;  ///< for an angle its period; 0 for other numbers
};

/// Reads a column. Whole turns are added so that its numbers do not jump.
/// \param shifts  out: what was added
void load_column(const Clip& clip, const Column& column, std::size_t lane,
                 simd::LaneFrames& numbers, simd::LaneFrames& shifts) {
  double before = 0;
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    const double number = clip.row(f)[column.index];
    const double shift =
        f > 0 && column.turn > 0 ? turns_towards(number, before, column.turn) : 0.0;
    before = number + shift;
    shifts.groups[f].v[lane] = shift;
    numbers.groups[f].v[lane] = before;
  }
}

/// Smooths up to `kLanes` columns. Jumps by whole turns are removed from angles before filtering
/// and restored after it.
void smooth_columns(const simd::LowPass& filter, std::span<const Column> columns, Clip& clip) {
  simd::LaneFrames numbers(clip.num_frames, 1, filter.padding);
  simd::LaneFrames shifts(clip.num_frames, 1);
  for (std::size_t k = 0; k < columns.size(); ++k)
    load_column(clip, columns[k], k, numbers, shifts);
  simd::low_pass(filter, numbers);
  const Rows rows = clip.mutate();
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      rows[f][columns[k].index] = numbers.groups[f].v[k] - shifts.groups[f].v[k];
    }
  }
}

/// A joint whose rotations are smoothed as one rotation.
struct TurningJoint {
  std::vector<DegreeOfFreedom> rotations;
  bool is_whole = false;  ///< see `is_whole_rotation`
  simd::EulerForm form;   ///< otherwise
};

/// Memory for some frames of a joint.
struct Batch {
  simd::Angles angles;
  simd::Quaternions rotations;
};

void load_angles(const TurningJoint& joint, const FrameBatch& frames, const Rows& rows,
                 simd::Angles& angles) {
  rotation::resize(angles, frames.count);
  for (std::size_t k = 0; k < 3; ++k) get_values(joint.rotations[k], frames, rows, angles[k]);
}

/// The quaternions of a joint in some frames. The kernel's
/// quaternions are the joint's own up to constant factors, and the filter is linear, so constant
/// factors commute with it.
void load_rotations(const TurningJoint& joint, AngleUnit unit, const FrameBatch& frames,
                    const Rows& rows, Batch& batch) {
  if (!joint.is_whole) {
    load_angles(joint, frames, rows, batch.angles);
    simd::quaternions_of_angles(joint.form, batch.angles, batch.rotations);
    return;
  }
  rotation::resize(batch.rotations, frames.count);
  for (std::size_t i = 0; i < frames.count; ++i) {
    const Quat q = whole_rotation_in_row(joint.rotations[0], rows[frames.first + i], unit);
    rotation::put_quaternion(q, i, batch.rotations);
  }
}

/// Copies a joint's quaternions to its lane.
void put_in_lane(const simd::Quaternions& rotations, const FrameBatch& frames, std::size_t lane,
                 simd::LaneFrames& numbers) {
  for (std::size_t k = 0; k < 4; ++k) {
    const double* const from = rotations[k].data();
    simd::LaneGroup* const to = numbers.frame(frames.first) + k;
    for (std::size_t i = 0; i < frames.count; ++i) to[i * 4].v[lane] = from[i];
  }
}

/// Copies a joint's quaternions from its lane.
/// \returns  the least square of a length
double take_from_lane(simd::LaneFrames& numbers, const FrameBatch& frames, std::size_t lane,
                      simd::Quaternions& rotations) {
  rotation::resize(rotations, frames.count);
  double* const w = rotations[0].data();
  double* const x = rotations[1].data();
  double* const y = rotations[2].data();
  double* const z = rotations[3].data();
  const simd::LaneGroup* const from = numbers.frame(frames.first);
  double least = 1;
  for (std::size_t i = 0; i < frames.count; ++i) {
    w[i] = from[i * 4].v[lane];
    x[i] = from[i * 4 + 1].v[lane];
    y[i] = from[i * 4 + 2].v[lane];
    z[i] = from[i * 4 + 3].v[lane];
    least = std::min(least, w[i] * w[i] + x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
  }
  return least;
}

/// Replaces quaternions of a length near 0 by old ones.
void mend(const simd::Quaternions& old, std::size_t count, simd::Quaternions& rotations) {
  for (std::size_t i = 0; i < count; ++i) {
    const bool has_direction =
        rotation::quaternion_at(rotations, i).squaredNorm() > kNoDirection * kNoDirection;
    if (!has_direction) rotation::put_quaternion(rotation::quaternion_at(old, i), i, rotations);
  }
}

/// Writes a joint's quaternions, of any length, to its columns.
void store_rotations(const TurningJoint& joint, AngleUnit unit, const FrameBatch& frames,
                     Batch& batch, const Rows& rows) {
  if (joint.is_whole) {
    for (std::size_t i = 0; i < frames.count; ++i) {
      const Quat q = rotation::quaternion_at(batch.rotations, i).normalized();
      set_whole_rotation(joint.rotations[0], q, unit, rows[frames.first + i]);
    }
    return;
  }
  load_angles(joint, frames, rows, batch.angles);  // which the new ones shall be near
  simd::angles_of_quaternions(joint.form, batch.rotations, batch.angles);
  for (std::size_t k = 0; k < 3; ++k) {
    put_values(joint.rotations[k], frames, batch.angles[k], rows);
  }
}

/// Smooths the rotations of up to `kLanes` joints by the components of their quaternions, each on
/// the side of the one before.
/// \param numbers  memory for their quaternions
void smooth_rotations(const simd::LowPass& filter, std::span<const TurningJoint> joints,
                      AngleUnit unit, const Rows& rows, simd::LaneFrames& numbers) {
  const std::vector<FrameBatch> batches = batches_of(numbers.num_frames);
  Batch batch;
  for (const FrameBatch& frames : batches) {
    for (std::size_t lane = 0; lane < joints.size(); ++lane) {
      load_rotations(joints[lane], unit, frames, rows, batch);
      put_in_lane(batch.rotations, frames, lane, numbers);
    }
  }
  simd::take_same_sides(numbers);
  simd::low_pass(filter, numbers);
  for (const FrameBatch& frames : batches) {
    for (std::size_t lane = 0; lane < joints.size(); ++lane) {
      const double least = take_from_lane(numbers, frames, lane, batch.rotations);
      if (!(least > kNoDirection * kNoDirection)) {
        Batch old;
        load_rotations(joints[lane], unit, frames, rows, old);
        mend(old.rotations, frames.count, batch.rotations);
      }
      store_rotations(joints[lane], unit, frames, batch, rows);
    }
  }
}

/// The columns of some degrees of freedom.
std::vector<std::size_t> columns_of(const std::vector<DegreeOfFreedom>& dofs) {
  std::vector<std::size_t> columns;
  for (const DegreeOfFreedom& dof : dofs) {
    for (std::size_t k = 0; k < num_coordinates(dof); ++k) columns.push_back(dof.coordinate + k);
  }
  return columns;
}

/// The joint for smoothing its rotations as one rotation, if they can be.
std::optional<TurningJoint> turning_joint(std::vector<DegreeOfFreedom> rotations, AngleUnit unit) {
  const auto axes = euler_axes_of(rotations);
  const bool is_whole = is_whole_rotation(rotations);
  const bool has_gains = std::all_of(rotations.begin(), rotations.end(),
                                     [](const DegreeOfFreedom& dof) { return dof.gain != 0; });
  if (!has_gains || (!axes && !is_whole)) return std::nullopt;
  TurningJoint joint{std::move(rotations), is_whole, {}};
  if (axes) joint.form = rotation::euler_form(*axes, unit == AngleUnit::Degrees);
  return joint;
}

/// The joints whose rotations are smoothed as one rotation: those that lead their columns.
std::vector<TurningJoint> turning_joints(const Skeleton& skeleton) {
  const std::vector<std::size_t> leaders = leaders_of_columns(skeleton);
  std::vector<TurningJoint> joints;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    auto rotations = rotations_of(skeleton.joints[j]);
    const auto follows = following_dofs(rotations, j, leaders);
    if (std::find(follows.begin(), follows.end(), true) != follows.end()) continue;
    auto joint = turning_joint(std::move(rotations), skeleton.angle_unit);
    if (joint) joints.push_back(std::move(*joint));
  }
  return joints;
}

/// Smooths all rotations that are smoothed as one.
/// \returns  by column: whether it is one of theirs
std::vector<bool> smooth_joints(const simd::LowPass& filter, Motion& motion) {
  std::vector<TurningJoint> joints = turning_joints(motion.skeleton);
  std::vector<bool> is_done(motion.skeleton.coordinates.size(), false);
  for (const TurningJoint& joint : joints) {
    for (const std::size_t column : columns_of(joint.rotations)) is_done[column] = true;
  }
  std::erase_if(joints, [&motion](const TurningJoint& joint) {
    return is_constant(motion.clip, columns_of(joint.rotations));
  });
  const Rows rows = motion.clip.mutate();
  const std::span<const TurningJoint> all = joints;
  for_each_group(all.size(), rows.values.size(), [&](std::size_t begin, std::size_t end) {
    simd::LaneFrames numbers(motion.clip.num_frames, 4, filter.padding);
    for (std::size_t first = begin; first < end; first += kLanes) {
      smooth_rotations(filter, all.subspan(first, std::min(kLanes, end - first)),
                       motion.skeleton.angle_unit, rows, numbers);
    }
  });
  return is_done;
}

std::optional<Error> find_not_finite(const Motion& motion) {
  const Clip& clip = motion.clip;
  if (all_finite({clip.values.data(), clip.values.size()})) return std::nullopt;
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    const auto row = clip.row(f);
    for (std::size_t c = 0; c < clip.num_coordinates; ++c) {
      if (std::isfinite(row[c])) continue;
      const Coordinate& column = motion.skeleton.coordinates[c];
      return make_error(ErrorKind::InvalidInput, "EDT008",
                        fmt::format("{} of joint '{}' is not finite in frame {}", column.channel,
                                    motion.skeleton.joints[column.joint].name, f));
    }
  }
  return std::nullopt;
}

}  // namespace

Result<Motion> smooth(Motion motion, double cutoff_hz) {
  if (has_own_times(motion.clip.timeline)) {
    return fail(make_error(ErrorKind::Usage, "EDT011",
                           "expected frames that are equally far apart, found times of their own; "
                           "resample the motion first"));
  }
  const double rate = frame_rate(motion.clip.timeline);
  if (!(cutoff_hz > 0 && cutoff_hz < rate / 2)) {
    return fail(make_error(ErrorKind::Usage, "EDT007",
                           fmt::format("expected a cut-off between 0 and half the frame rate, {} "
                                       "Hz, found {}",
                                       rate / 2, cutoff_hz)));
  }
  if (auto error = find_not_finite(motion)) return fail(std::move(*error));
  const simd::LowPass filter = low_pass_of(cutoff_hz, rate);
  const std::vector<double> turns = turns_of_columns(motion.skeleton);
  const std::vector<bool> is_done = smooth_joints(filter, motion);
  std::vector<Column> columns;
  for (std::size_t c = 0; c < is_done.size(); ++c) {
    if (!is_done[c] && !is_constant(motion.clip, {c})) columns.push_back({c, turns[c]});
  }
  for (std::size_t c = 0; c < columns.size(); c += kLanes) {
    const std::span<const Column> all = columns;
    smooth_columns(filter, all.subspan(c, std::min(kLanes, all.size() - c)), motion.clip);
  }
  return motion;
}

}  // namespace kinefile::edit
