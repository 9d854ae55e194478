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

namespace kinefile::edit {
namespace {

/// How many columns are filtered at a time: a single one would wait for each previous result.
constexpr std::size_t kLanes = 4;
using Lanes = std::array<double, kLanes>;

/// A Butterworth filter of second order, run in both directions.
class Filter {
 public:
  Filter(double cutoff_hz, double rate_hz) {
    // Two passes together halve the power at (sqrt 2 - 1)^(1/4) of the cut-off of one pass. So the
    // cut-off of one pass is higher by that factor, in the frequencies of the bilinear transform.
    const double correction = std::pow(std::numbers::sqrt2 - 1, 0.25);
    const double w = std::tan(std::numbers::pi * cutoff_hz / rate_hz) / correction;
    const double scale = 1 / (1 + std::numbers::sqrt2 * w + w * w);
    b0_ = w * w * scale;
    a1_ = 2 * (w * w - 1) * scale;
    a2_ = (1 - std::numbers::sqrt2 * w + w * w) * scale;
    const double periods = 2 * rate_hz / cutoff_hz;
    padding_ = periods < 1e9 ? static_cast<std::size_t>(periods) + 9 : kMostPadding;
  }

  /// Filters columns in place. They are extended at both ends by odd reflection. A column whose
  /// numbers are all the same keeps every bit.
  void run(std::vector<Lanes>& rows) const {
    const std::size_t count = rows.size();
    if (count < 2) return;
    const Lanes is_moving = moving_lanes(rows);
    const std::size_t padding = std::min({padding_, count - 1, kMostPadding});
    // The straight line between the ends is subtracted first, because the filter keeps it. So the
    // filter starts at rest, and components slower than the length of the motion remain as that
    // line.
    const Lanes origin = rows.front();
    Lanes slope;
    for (std::size_t k = 0; k < kLanes; ++k) {
      slope[k] = (rows.back()[k] - origin[k]) / static_cast<double>(count - 1);
    }
    std::vector<Lanes> padded(count + 2 * padding);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < kLanes; ++k) {
        padded[padding + i][k] = rows[i][k] - (origin[k] + slope[k] * static_cast<double>(i));
      }
    }
    padded[padding + count - 1] = {};
    for (std::size_t i = 1; i <= padding; ++i) {
      for (std::size_t k = 0; k < kLanes; ++k) {
        padded[padding - i][k] = -padded[padding + i][k];
        padded[padding + count - 1 + i][k] = -padded[padding + count - 1 - i][k];
      }
    }
    run_one_way(padded.begin(), padded.end());
    run_one_way(padded.rbegin(), padded.rend());
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < kLanes; ++k) {
        const double line = origin[k] + slope[k] * static_cast<double>(i);
        if (is_moving[k] != 0) rows[i][k] = line + padded[padding + i][k];
      }
    }
  }

 private:
  static constexpr std::size_t kMostPadding = 1'000'000;

  /// 1 for columns in which a number differs from the previous one, otherwise 0.
  static Lanes moving_lanes(const std::vector<Lanes>& rows) {
    Lanes is_moving{};
    for (std::size_t i = 1; i < rows.size(); ++i) {
      for (std::size_t k = 0; k < kLanes; ++k) {
        if (rows[i][k] != rows[i - 1][k]) is_moving[k] = 1;
      }
    }
    return is_moving;
  }

  /// One pass (transposed direct form), starting from the steady state for the first number.
  template <class Iterator>
  void run_one_way(Iterator begin, Iterator end) const {
    Lanes z1;
    Lanes z2;
    for (std::size_t k = 0; k < kLanes; ++k) {
      z1[k] = (1 - b0_) * (*begin)[k];
      z2[k] = (b0_ - a2_) * (*begin)[k];
    }
    for (Iterator row = begin; row != end; ++row) {
      for (std::size_t k = 0; k < kLanes; ++k) {
        const double in = (*row)[k];
        const double out = b0_ * in + z1[k];
        z1[k] = 2 * b0_ * in - a1_ * out + z2[k];
        z2[k] = b0_ * in - a2_ * out;
        (*row)[k] = out;
      }
    }
  }

  double b0_, a1_, a2_;  ///< b = b0 (1, 2, 1), a = (1, a1, a2)
  std::size_t padding_;
};

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

/// The whole turns added to the numbers of a column so that they do not jump.
void take_turns_out(double turn, std::size_t lane, std::vector<Lanes>& rows,
                    std::vector<Lanes>& shifts) {
  for (std::size_t f = 1; f < rows.size(); ++f) {
    shifts[f][lane] = turns_towards(rows[f][lane], rows[f - 1][lane], turn);
    rows[f][lane] += shifts[f][lane];
  }
}

/// Smooths up to `kLanes` columns. Jumps by whole turns are removed from angles before filtering
/// and restored after it.
void smooth_columns(const Filter& filter, std::span<const Column> columns, Clip& clip) {
  std::vector<Lanes> numbers(clip.num_frames);
  std::vector<Lanes> shifts(clip.num_frames);
  const Rows rows = clip.mutate();
  for (std::size_t f = 0; f < numbers.size(); ++f) {
    for (std::size_t k = 0; k < columns.size(); ++k) numbers[f][k] = rows[f][columns[k].index];
  }
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k].turn > 0) take_turns_out(columns[k].turn, k, numbers, shifts);
  }
  filter.run(numbers);
  for (std::size_t f = 0; f < numbers.size(); ++f) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      rows[f][columns[k].index] = numbers[f][k] - shifts[f][k];
    }
  }
}

/// Smooths rotations by the components of their quaternions, each on the side of the one before.
/// The results are not normalised; a result of a length near 0 is replaced by the old quaternion.
void smooth_rotations(const Filter& filter, std::vector<Lanes>& quaternions) {
  const auto dot = [](const Lanes& a, const Lanes& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  };
  for (std::size_t f = 1; f < quaternions.size(); ++f) {
    if (dot(quaternions[f], quaternions[f - 1]) >= 0) continue;
    for (double& component : quaternions[f]) component = -component;
  }
  std::vector<Lanes> smooth = quaternions;
  filter.run(smooth);
  constexpr double kNoDirection = 1e-6;
  for (std::size_t f = 0; f < smooth.size(); ++f) {
    if (dot(smooth[f], smooth[f]) > kNoDirection * kNoDirection) quaternions[f] = smooth[f];
  }
}

/// Smooths the three rotations of a joint. The kernel's quaternions are the joint's own up to
/// constant factors, and the filter is linear, so constant factors commute with it.
void smooth_euler(const Filter& filter, const std::vector<DegreeOfFreedom>& dofs,
                  const simd::EulerForm& form, Clip& clip) {
  simd::Angles angles;
  simd::Quaternions rotations;
  std::vector<Lanes> quaternions(clip.num_frames);
  const Rows rows = clip.mutate();
  const auto load = [&](const FrameBatch& frames) {
    rotation::resize(angles, frames.count);
    for (std::size_t i = 0; i < frames.count; ++i) {
      const auto row = rows[frames.first + i];
      for (std::size_t k = 0; k < 3; ++k) angles[k][i] = value_in_row(dofs[k], row);
    }
  };
  for (const FrameBatch& frames : batches_of(clip.num_frames)) {
    load(frames);
    simd::quaternions_of_angles(form, angles, rotations);
    for (std::size_t i = 0; i < frames.count; ++i) {
      for (std::size_t k = 0; k < 4; ++k) quaternions[frames.first + i][k] = rotations[k][i];
    }
  }
  smooth_rotations(filter, quaternions);
  for (const FrameBatch& frames : batches_of(clip.num_frames)) {
    load(frames);
    rotation::resize(rotations, frames.count);
    for (std::size_t i = 0; i < frames.count; ++i) {
      for (std::size_t k = 0; k < 4; ++k) rotations[k][i] = quaternions[frames.first + i][k];
    }
    simd::angles_of_quaternions(form, rotations, angles);
    for (std::size_t i = 0; i < frames.count; ++i) {
      const auto row = rows[frames.first + i];
      for (std::size_t k = 0; k < 3; ++k) {
        row[dofs[k].coordinate] = column_of(dofs[k], angles[k][i]);
      }
    }
  }
}

void smooth_whole(const Filter& filter, const DegreeOfFreedom& dof, AngleUnit unit, Clip& clip) {
  std::vector<Lanes> quaternions;
  const Rows rows = clip.mutate();
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    const Quat q = whole_rotation_in_row(dof, rows[f], unit);
    quaternions.push_back({q.w(), q.x(), q.y(), q.z()});
  }
  smooth_rotations(filter, quaternions);
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    const Lanes& q = quaternions[f];
    set_whole_rotation(dof, Quat(q[0], q[1], q[2], q[3]).normalized(), unit, rows[f]);
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

/// Smooths the rotations of a joint as one rotation, if the joint leads their columns, and marks
/// these columns.
/// \param leads    whether the joint follows no other in any of these columns
/// \param is_done  by column; several threads mark theirs
void smooth_joint(const Filter& filter, const std::vector<DegreeOfFreedom>& rotations, bool leads,
                  AngleUnit unit, std::vector<char>& is_done, Clip& clip) {
  const auto axes = euler_axes_of(rotations);
  const bool is_whole = is_whole_rotation(rotations);
  const bool has_gains = std::all_of(rotations.begin(), rotations.end(),
                                     [](const DegreeOfFreedom& dof) { return dof.gain != 0; });
  if (!leads || !has_gains || (!axes && !is_whole)) return;
  const std::vector<std::size_t> columns = columns_of(rotations);
  for (const std::size_t column : columns) is_done[column] = 1;
  if (is_constant(clip, columns)) return;
  if (is_whole) {
    smooth_whole(filter, rotations[0], unit, clip);
  } else {
    const auto form = rotation::euler_form(*axes, unit == AngleUnit::Degrees);
    smooth_euler(filter, rotations, form, clip);
  }
}

/// Smooths all rotations that are smoothed as a whole. Returns which columns they have.
std::vector<char> smooth_joints(const Filter& filter, Motion& motion) {
  const Skeleton& skeleton = motion.skeleton;
  const std::vector<std::size_t> leaders = leaders_of_columns(skeleton);
  std::vector<char> is_done(skeleton.coordinates.size(), 0);
  motion.clip.mutate();  // not shared from here on, so that threads find it so
  const auto smooth_some = [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      const auto rotations = rotations_of(skeleton.joints[j]);
      const auto follows = following_dofs(rotations, j, leaders);
      const bool leads = std::find(follows.begin(), follows.end(), true) == follows.end();
      smooth_joint(filter, rotations, leads, skeleton.angle_unit, is_done, motion.clip);
    }
  };
  for_each_group(skeleton.joints.size(), motion.clip.values.size(), smooth_some);
  return is_done;
}

std::optional<Error> find_not_finite(const Motion& motion) {
  const Clip& clip = motion.clip;
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    const auto row = clip.row(f);
    if (all_finite(row)) continue;
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
  const Filter filter(cutoff_hz, rate);
  const std::vector<double> turns = turns_of_columns(motion.skeleton);
  const std::vector<char> is_done = smooth_joints(filter, motion);
  std::vector<Column> columns;
  for (std::size_t c = 0; c < is_done.size(); ++c) {
    if (is_done[c] == 0) columns.push_back({c, turns[c]});
  }
  for (std::size_t c = 0; c < columns.size(); c += kLanes) {
    const std::span<const Column> all = columns;
    smooth_columns(filter, all.subspan(c, std::min(kLanes, all.size() - c)), motion.clip);
  }
  return motion;
}

}  // namespace kinefile::edit
