// SPDX-License-Identifier: MIT
#include "kinematics/rotation_batches.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace kinefile {

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
  std::vector<Vec3> axes;
  rotation::AngleColumns angles;
  for (const DegreeOfFreedom& dof : rotations) {
    axes.push_back(dof.axis);
    std::vector<double>& column = angles.emplace_back(simd::padded(frames.count));
    for (std::size_t i = 0; i < frames.count; ++i) {
      column[i] = clip.row(frames.first + i)[dof.coordinate];
    }
  }
  rotation::products_of_rotations(axes, angles, frames.count, unit == AngleUnit::Degrees, out);
}

RotationFitter::RotationFitter(std::vector<DegreeOfFreedom> rotations, AngleUnit unit,
                               std::span<const double> start)
    : rotations_(std::move(rotations)), unit_(unit) {
  if (const auto axes = euler_axes_of(rotations_)) {
    const Vec3 angles(start[rotations_[0].coordinate], start[rotations_[1].coordinate],
                      start[rotations_[2].coordinate]);
    finder_.emplace(*axes, unit == AngleUnit::Degrees, angles);
  } else {
    near_.assign(start.begin(), start.end());
  }
}

double RotationFitter::fit(simd::Quaternions& quaternions, const FrameBatch& frames,
                           const Rows& rows) {
  if (!finder_) return fit_one_by_one(quaternions, frames, rows);
  finder_->find(quaternions, frames.count, angles_);
  for (std::size_t i = 0; i < frames.count; ++i) {
    const auto row = rows[frames.first + i];
    for (std::size_t k = 0; k < 3; ++k) row[rotations_[k].coordinate] = angles_[k][i];
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
    if (is_finite) {
      const Mat3 matrix = rotation.toRotationMatrix();
      largest = std::max(largest, fit_rotation(rotations_, matrix, unit_, near_));
    }
    for (const DegreeOfFreedom& dof : rotations_) {
      row[dof.coordinate] =
          is_finite ? near_[dof.coordinate] : std::numeric_limits<double>::quiet_NaN();
    }
  }
  return largest;
}

}  // namespace kinefile
