// SPDX-License-Identifier: MIT
#include "kinematics/rotation_batches.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "kinematics/kinematics_plan.hpp"

namespace kinefile {
namespace {

/// Copies the numbers of a degree of freedom, whose columns differ in the two rows.
void copy_columns(const DegreeOfFreedom& from_dof, std::span<const double> from,
                  const DegreeOfFreedom& to_dof, std::span<double> to) {
  std::copy_n(&from[from_dof.coordinate], num_coordinates(to_dof), &to[to_dof.coordinate]);
}

}  // namespace

std::vector<FrameBatch> batches_of(std::size_t num_frames) {
  constexpr std::size_t kFramesPerBatch = 64;
  std::vector<FrameBatch> batches;
  for (std::size_t first = 0; first < num_frames; first += kFramesPerBatch) {
    batches.push_back({first, std::min(kFramesPerBatch, num_frames - first)});
  }
  return batches;
}

void get_values(const DegreeOfFreedom& dof, const FrameBatch& frames, const Rows& rows,
                std::span<double> out) {
  const double* const from = rows.values.data() + frames.first * rows.width + dof.coordinate;
  double* const to = out.data();
  for (std::size_t i = 0; i < frames.count; ++i) to[i] = from[i * rows.width];
  if (is_plain(dof)) return;
  for (std::size_t i = 0; i < frames.count; ++i) to[i] = value_of(dof, to[i]);
}

void put_values(const DegreeOfFreedom& dof, const FrameBatch& frames,
                std::span<const double> values, const Rows& rows) {
  const double* const from = values.data();
  double* const to = rows.values.data() + frames.first * rows.width + dof.coordinate;
  if (is_plain(dof)) {
    for (std::size_t i = 0; i < frames.count; ++i) to[i * rows.width] = from[i];
  } else {
    for (std::size_t i = 0; i < frames.count; ++i) to[i * rows.width] = column_of(dof, from[i]);
  }
}

RotationReader::RotationReader(const std::vector<DegreeOfFreedom>& rotations, AngleUnit unit)
    : unit_(unit) {
  if (is_whole_rotation(rotations)) {
    whole_ = rotations;
  } else {
    for (const DegreeOfFreedom& dof : rotations) turns_.push_back(plan_turn(dof));
  }
}

void RotationReader::read(const Clip& clip, const FrameBatch& frames,
                          simd::Quaternions& out) const {
  if (whole_.empty()) {
    const simd::Rows rows{clip.values.data() + frames.first * clip.num_coordinates, frames.count,
                          clip.num_coordinates};
    simd::products_of_turns(turns_, unit_ == AngleUnit::Degrees, rows, out);
    return;
  }
  rotation::resize(out, frames.count);
  for (std::size_t i = 0; i < frames.count; ++i) {
    const Quat q = whole_rotation_in_row(whole_[0], clip.row(frames.first + i), unit_);
    rotation::put_quaternion(q, i, out);
  }
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
  for (std::size_t k = 0; k < 3; ++k) put_values(rotations_[k], frames, angles_[k], rows);
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
