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

/// Brings many rotations back to the degrees of freedom of a joint, each near the one before:
/// `fit_rotation` for many.
class RotationFitter {
 public:
  /// \param rotations  of `rotations_of`
  /// \param start      a row with the numbers that the first are to be near
  /// \param follows    rotations that stay as they are (see `fit_rotation`)
  RotationFitter(std::vector<DegreeOfFreedom> rotations, AngleUnit unit,
                 std::span<const double> start, std::vector<bool> follows = {});

  /// Writes the numbers of the next rotations; NaN for one that is not finite.
  /// \param quaternions  one a frame; in: the rotations; out: without meaning
  /// \returns            the largest residual angle, in radians
  double fit(simd::Quaternions& quaternions, const FrameBatch& frames, const Rows& rows);

 private:
  double fit_one_by_one(const simd::Quaternions& quaternions, const FrameBatch& frames,
                        const Rows& rows);

  std::vector<DegreeOfFreedom> rotations_;
  AngleUnit unit_;
  std::vector<bool> follows_;
  std::optional<rotation::AngleFinder> finder_;  ///< where the axes are three that allow it
  std::vector<double> near_;                     ///< else: a row with the numbers before
  simd::Angles angles_;
};

}  // namespace kinefile
