// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "kinefile/clip.hpp"
#include "kinefile/joint_rotation.hpp"
#include "rotation/rotations.hpp"

namespace kinefile {

/// Some frames of a clip, one after another.
struct FrameBatch {
  std::size_t first = 0;
  std::size_t count = 0;
};

/// The frames of a clip in batches that stay in the processor's cache.
std::vector<FrameBatch> batches_of(std::size_t num_frames);

/// The products of a joint's rotations in some rows: `quaternion_in_row` for many.
/// \param rotations  of `rotations_of`
void rotations_in_rows(const std::vector<DegreeOfFreedom>& rotations, const Clip& clip,
                       const FrameBatch& frames, AngleUnit unit, simd::Quaternions& out);

/// Finds the values of a joint's degrees of freedom for many rotations, each near the previous one:
/// `fit_rotation` for many.
class RotationFitter {
 public:
  /// \param rotations  of `rotations_of`
  /// \param start      a row with the numbers that the first ones shall be near
  /// \param follows    rotations that keep their values (see `fit_rotation`)
  RotationFitter(std::vector<DegreeOfFreedom> rotations, AngleUnit unit,
                 std::span<const double> start, std::vector<bool> follows = {});

  /// Writes the numbers of the next rotations; NaN for one that is not finite.
  /// \param quaternions  one per frame; in: the rotations; out: unspecified
  /// \returns            the largest residual angle, in radians
  double fit(simd::Quaternions& quaternions, const FrameBatch& frames, const Rows& rows);

 private:
  void begin_near(std::span<const double> start);
  double fit_one_by_one(const simd::Quaternions& quaternions, const FrameBatch& frames,
                        const Rows& rows);

  std::vector<DegreeOfFreedom> rotations_;
  AngleUnit unit_;
  std::vector<bool> follows_;
  std::optional<rotation::AngleFinder> finder_;  ///< if three axes can represent every rotation
  std::vector<DegreeOfFreedom> near_dofs_;       ///< otherwise: the same, of the columns in `near_`
  std::vector<double> near_;                     ///< with the previous numbers
  simd::Angles angles_;
};

}  // namespace kinefile
