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

/// Reads the values of a degree of freedom that reads one column.
/// \param out  one a frame; may be longer
void get_values(const DegreeOfFreedom& dof, const FrameBatch& frames, const Rows& rows,
                std::span<double> out);

/// Writes the numbers by which a degree of freedom that reads one column has some values.
void put_values(const DegreeOfFreedom& dof, const FrameBatch& frames,
                std::span<const double> values, const Rows& rows);

/// Reads the products of a joint's rotations from many rows: `quaternion_in_row` for many.
class RotationReader {
 public:
  /// \param rotations  of `rotations_of`
  RotationReader(const std::vector<DegreeOfFreedom>& rotations, AngleUnit unit);

  /// \param out  one unit quaternion a frame, padded
  void read(const Clip& clip, const FrameBatch& frames, simd::Quaternions& out) const;

 private:
  std::vector<DegreeOfFreedom> whole_;  ///< a whole rotation, or none
  std::vector<simd::Turn> turns_;
  AngleUnit unit_;
};

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
