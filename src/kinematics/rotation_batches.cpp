// SPDX-License-Identifier: MIT
#include "kinematics/rotation_batches.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace kinefile {
namespace {

/// Copies the numbers of a degree of freedom, whose columns differ in the two rows.
void copy_columns(const DegreeOfFreedom& from_dof, std::span<const double> from,
                  const DegreeOfFreedom& to_dof, std::span<double> to) {
  std::copy_n(&from[from_dof.coordinate], num_coordinates(to_dof), &to[to_dof.coordinate]);
}

}  // namespace

std::vector<FrameBatch> batches_of(std::size_t num_frames) {
  constexpr std::size_t kFramesPerBatch = 512;
  std::vector<FrameBatch> batches;
  for (std::size_t first = 0; first < num_frames; first += kFramesPerBatch) {
    batches.push_back({first, std::min(kFramesPerBatch, num_frames - first)});
  }
  return batches;
}

void rotations_in_rows(const std::vector<DegreeOfFreedom>& rotations, const Clip& clip,
                       const FrameBatch& frames, AngleUnit unit, simd::Quaternions& out) {
  if (is_whole_rotation(rotations)) {
    rotation::resize(out, frames.count);
    for (std::size_t i = 0; i < frames.count; ++i) {
      const Quat q = quaternion_in_row(rotations, clip.row(frames.first + i), unit);
      rotation::put_quaternion(q, i, out);
    }
    return;
  }
  std::vector<Vec3> axes;
  rotation::AngleColumns angles;
  for (const DegreeOfFreedom& dof : rotations) {
    axes.push_back(dof.axis);
    std::vector<double>& column = angles.emplace_back(simd::padded(frames.count));
    for (std::size_t i = 0; i < frames.count; ++i) {
      column[i] = value_of(dof, clip.row(frames.first + i)[dof.coordinate]);
    }
  }
  rotation::products_of_rotations(axes, angles, frames.count, unit == AngleUnit::Degrees, out);
}

RotationFitter::RotationFitter(std::vector<DegreeOfFreedom> rotations, AngleUnit unit,
                               std::span<const double> start, std::vector<bool> follows)
    : rotations_(std::move(rotations)), unit_(unit), follows_(std::move(follows)) {
  const auto axes = euler_axes_of(rotations_);
  const bool is_any_fixed = std::find(follows_.begin(), follows_.end(), true) != follows_.end() ||
                            std::any_of(rotations_.begin(), rotations_.end(),
                                        [](const DegreeOfFreedom& dof) { return dof.gain == 0; });
  if (axes && !is_any_fixed) {
    const auto angle = [&](std::size_t k) {
      return value_of(rotations_[k], start[rotations_[k].coordinate]);
    };
    finder_.emplace(*axes, unit == AngleUnit::Degrees, Vec3(angle(0), angle(1), angle(2)));
  } else {
    begin_near(start);
  }
}

/// Keeps just the joint's own columns: rows of many joints are long.
void RotationFitter::begin_near(std::span<const double> start) {
  std::map<std::size_t, std::size_t> places;  // two may read one column
  near_dofs_ = rotations_;
  for (std::size_t d = 0; d < rotations_.size(); ++d) {
    const std::size_t count = num_coordinates(rotations_[d]);
    const auto [place, is_new] = places.emplace(rotations_[d].coordinate, near_.size());
    near_dofs_[d].coordinate = place->second;
    near_.resize(std::max(near_.size(), place->second + count));
    copy_columns(rotations_[d], start, near_dofs_[d], near_);
  }
}

double RotationFitter::fit(simd::Quaternions& quaternions, const FrameBatch& frames,
                           const Rows& rows) {
  if (!finder_) return fit_one_by_one(quaternions, frames, rows);
  finder_->find(quaternions, frames.count, angles_);
  for (std::size_t i = 0; i < frames.count; ++i) {
    const auto row = rows[frames.first + i];
    for (std::size_t k = 0; k < 3; ++k) {
      row[rotations_[k].coordinate] = column_of(rotations_[k], angles_[k][i]);
    }
  }
  return 0;
}

double RotationFitter::fit_one_by_one(const simd::Quaternions& quaternions,
                                      const FrameBatch& frames, const Rows& rows) {
  double largest = 0;
  for (std::size_t i = 0; i < frames.count; ++i) {
    const auto row = rows[frames.first + i];
    const Quat rotation = rotation::quaternion_at(quaternions, i);
    const bool is_finite = rotation.coeffs().allFinite();
    for (std::size_t d = 0; d < rotations_.size(); ++d) {  // values that other joints lead are in
                                                           // the row already
      if (!follows_.empty() && follows_[d]) copy_columns(rotations_[d], row, near_dofs_[d], near_);
    }
    const bool is_exact = is_whole_rotation(rotations_) && (follows_.empty() || !follows_[0]);
    if (is_finite && is_exact) {
      set_whole_rotation(near_dofs_[0], rotation, unit_, near_);
    } else if (is_finite) {
      const Mat3 matrix = rotation.toRotationMatrix();
      largest = std::max(largest, fit_rotation(near_dofs_, matrix, unit_, near_, follows_));
    }
    for (std::size_t d = 0; d < rotations_.size(); ++d) {
      if (!follows_.empty() && follows_[d]) continue;
      const DegreeOfFreedom& dof = rotations_[d];
      if (is_finite) {
        copy_columns(near_dofs_[d], near_, dof, row);
      } else {
        std::fill_n(&row[dof.coordinate], num_coordinates(dof),
                    std::numeric_limits<double>::quiet_NaN());
      }
    }
  }
  return largest;
}

}  // namespace kinefile
