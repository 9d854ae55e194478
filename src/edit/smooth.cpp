// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "kinefile/edit.hpp"
#include "kinefile/joint_rotation.hpp"
#include "kinematics/joint_columns.hpp"

namespace kinefile::edit {
namespace {

/// A Butterworth filter of second order, run in both directions.
class Filter {
 public:
  Filter(double cutoff_hz, double rate_hz) {
    // Two passes halve the power where each takes (sqrt 2 - 1)^(1/4) of the frequency: the
    // cut-off of one pass lies higher by that, in the frequencies of the bilinear transform.
    const double correction = std::pow(std::numbers::sqrt2 - 1, 0.25);
    const double w = std::tan(std::numbers::pi * cutoff_hz / rate_hz) / correction;
    const double scale = 1 / (1 + std::numbers::sqrt2 * w + w * w);
    b0_ = w * w * scale;
    a1_ = 2 * (w * w - 1) * scale;
    a2_ = (1 - std::numbers::sqrt2 * w + w * w) * scale;
    const double periods = 2 * rate_hz / cutoff_hz;
    padding_ = periods < 1e9 ? static_cast<std::size_t>(periods) + 9 : kMostPadding;
  }

  /// Filters numbers in place. They are continued at both ends by their odd reflections.
  void run(std::vector<double>& numbers) const {
    const std::size_t count = numbers.size();
    if (count < 2) return;
    const bool is_still =
        std::adjacent_find(numbers.begin(), numbers.end(), std::not_equal_to<>()) == numbers.end();
    if (is_still) return;
    const std::size_t padding = std::min({padding_, count - 1, kMostPadding});
    // About the straight line between the ends, which the filter keeps: so it starts at rest, and
    // what is slower than the motion is long comes out as that line.
    const double origin = numbers.front();
    const double slope = (numbers.back() - origin) / static_cast<double>(count - 1);
    const auto line_at = [&](std::size_t i) { return origin + slope * static_cast<double>(i); };
    std::vector<double> padded(count + 2 * padding);
    for (std::size_t i = 0; i < count; ++i) padded[padding + i] = numbers[i] - line_at(i);
    padded[padding + count - 1] = 0;
    for (std::size_t i = 1; i <= padding; ++i) {
      padded[padding - i] = -padded[padding + i];
      padded[padding + count - 1 + i] = -padded[padding + count - 1 - i];
    }
    run_forwards(padded);
    std::reverse(padded.begin(), padded.end());
    run_forwards(padded);
    std::reverse(padded.begin(), padded.end());
    for (std::size_t i = 0; i < count; ++i) numbers[i] = line_at(i) + padded[padding + i];
  }

 private:
  static constexpr std::size_t kMostPadding = 1'000'000;

  /// One pass (transposed direct form), from the state in which the first number has always been.
  void run_forwards(std::vector<double>& numbers) const {
    const double start = numbers.front();
    double z1 = (1 - b0_) * start;
    double z2 = (b0_ - a2_) * start;
    for (double& number : numbers) {
      const double in = number;
      number = b0_ * in + z1;
      z1 = 2 * b0_ * in - a1_ * number + z2;
      z2 = b0_ * in - a2_ * number;
    }
  }

  double b0_, a1_, a2_;  ///< b = b0 (1, 2, 1), a = (1, a1, a2)
  std::size_t padding_;
};

std::vector<double> column_of(const Clip& clip, std::size_t column) {
  std::vector<double> numbers;
  numbers.reserve(clip.num_frames);
  for (std::size_t f = 0; f < clip.num_frames; ++f) numbers.push_back(clip.row(f)[column]);
  return numbers;
}

/// Whether some columns have the same value in every frame.
bool is_constant(const Clip& clip, const std::vector<std::size_t>& columns) {
  return clip.num_frames == 0 ||
         std::all_of(columns.begin(), columns.end(), [&clip](std::size_t column) {
           return is_always(clip, column, clip.row(0)[column]);
         });
}

void smooth_column(const Filter& filter, std::size_t column, Clip& clip) {
  std::vector<double> numbers = column_of(clip, column);
  filter.run(numbers);
  for (std::size_t f = 0; f < clip.num_frames; ++f) clip.mutate()[f][column] = numbers[f];
}

/// Smooths angles as if they did not jump by whole turns; where they did, they still do.
void smooth_angle(const Filter& filter, std::size_t column, double turn, Clip& clip) {
  std::vector<double> numbers = column_of(clip, column);
  std::vector<double> shifts(numbers.size(), 0.0);
  for (std::size_t f = 1; f < numbers.size(); ++f) {
    shifts[f] = turn * std::round((numbers[f - 1] - numbers[f]) / turn);
    numbers[f] += shifts[f];
  }
  filter.run(numbers);
  for (std::size_t f = 0; f < clip.num_frames; ++f)
    clip.mutate()[f][column] = numbers[f] - shifts[f];
}

/// Smooths rotations by the components of their quaternions, each on the side of the one before.
void smooth_rotations(const Filter& filter, std::vector<Quat>& rotations) {
  for (std::size_t f = 1; f < rotations.size(); ++f) {
    rotations[f] = on_side_of(rotations[f], rotations[f - 1]);
  }
  std::vector<Quat> smooth = rotations;
  for (Eigen::Index k = 0; k < 4; ++k) {
    std::vector<double> component;
    for (const Quat& rotation : rotations) component.push_back(rotation.coeffs()[k]);
    filter.run(component);
    for (std::size_t f = 0; f < smooth.size(); ++f) smooth[f].coeffs()[k] = component[f];
  }
  constexpr double kNoDirection = 1e-6;
  for (std::size_t f = 0; f < smooth.size(); ++f) {
    if (smooth[f].norm() > kNoDirection) rotations[f] = smooth[f].normalized();
  }
}

/// Smooths the three rotations of a joint.
void smooth_euler(const Filter& filter, const std::vector<DegreeOfFreedom>& dofs, AngleUnit unit,
                  Clip& clip) {
  std::vector<Quat> rotations;
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    rotations.emplace_back(rotation_in_row(dofs, clip.row(f), unit));
  }
  smooth_rotations(filter, rotations);
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    fit_rotation(dofs, rotations[f].toRotationMatrix(), unit, clip.mutate()[f]);
  }
}

void smooth_free(const Filter& filter, std::size_t column, Clip& clip) {
  std::vector<Quat> rotations;
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    rotations.push_back(free_rotation(clip.row(f), column));
  }
  smooth_rotations(filter, rotations);
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    set_free_rotation(clip.mutate()[f], column, rotations[f]);
  }
}

/// How a column is smooth where it is not part of a joint's rotation.
enum class As { Number, Angle, Done };

std::vector<As> kinds_of_columns(const Skeleton& skeleton) {
  std::vector<As> kinds(skeleton.coordinates.size(), As::Number);
  for (const Joint& joint : skeleton.joints) {
    for (const DegreeOfFreedom& dof : rotations_of(joint)) kinds[dof.coordinate] = As::Angle;
  }
  return kinds;
}

/// Smooths the rotation of a joint as a whole, where it is one, and marks its columns.
void smooth_joint(const Filter& filter, const Joint& joint, AngleUnit unit, std::vector<As>& kinds,
                  Clip& clip) {
  std::vector<std::size_t> columns;
  const auto rotations = rotations_of(joint);
  const auto free = free_column(joint);
  if (free) columns = {*free + 3, *free + 4, *free + 5, *free + 6};
  if (euler_axes_of(rotations)) {
    for (const DegreeOfFreedom& dof : rotations) columns.push_back(dof.coordinate);
  }
  for (const std::size_t column : columns) kinds[column] = As::Done;
  if (columns.empty() || is_constant(clip, columns)) return;
  if (free) {
    smooth_free(filter, *free, clip);
  } else {
    smooth_euler(filter, rotations, unit, clip);
  }
}

std::optional<Error> find_not_finite(const Motion& motion) {
  const Clip& clip = motion.clip;
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    for (std::size_t c = 0; c < clip.num_coordinates; ++c) {
      if (std::isfinite(clip.row(f)[c])) continue;
      const Coordinate& column = motion.skeleton.coordinates[c];
      return make_error(ErrorKind::InvalidInput, "EDT008",
                        fmt::format("{} of joint '{}' is not finite in frame {}", column.channel,
                                    motion.skeleton.joints[column.joint].name, f));
    }
  }
  return std::nullopt;
}

}  // namespace

Result<Motion> smooth(const Motion& motion, double cutoff_hz) {
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
  const Skeleton& skeleton = motion.skeleton;
  Motion result = motion;
  std::vector<As> kinds = kinds_of_columns(skeleton);
  for (const Joint& joint : skeleton.joints) {
    smooth_joint(filter, joint, skeleton.angle_unit, kinds, result.clip);
  }
  for (std::size_t c = 0; c < kinds.size(); ++c) {
    if (kinds[c] == As::Number) smooth_column(filter, c, result.clip);
    if (kinds[c] == As::Angle) {
      smooth_angle(filter, c, whole_turn(skeleton.angle_unit), result.clip);
    }
  }
  return result;
}

}  // namespace kinefile::edit
