// SPDX-License-Identifier: MIT
// Many rotations of one joint at a time: from angles to quaternions and back, by the kernel that
// interpolation uses. `rotation_in_row`, `euler_angles` and `fit_rotation` do the same one by one.
#pragma once

#include <array>
#include <cstddef>

#include "kinefile/math.hpp"
#include "simd/angles.hpp"

namespace kinefile::rotation {

/// Three axes (see `euler_angles`) in the form that the kernel needs.
simd::EulerForm euler_form(const EulerAxes& axes, bool is_in_degrees);

/// Sets the number of vectors; the padding is unspecified.
template <std::size_t kSize>
void resize(simd::Components<kSize>& components, std::size_t count) {
  for (auto& component : components) component.resize(simd::padded(count));
}

Quat quaternion_at(const simd::Quaternions& quaternions, std::size_t i);
void put_quaternion(const Quat& value, std::size_t i, simd::Quaternions& quaternions);

/// Rotates the axes of rotations: the results have the same angles about axes transformed by a
/// matrix.
/// \param turn  a rotation, or the negative of a reflection
void turn_axes(const Mat3& turn, simd::Quaternions& quaternions);

/// The basis of three axes: the first, the second and their cross product (see `simd::EulerForm`).
simd::Matrix kernel_from_joint(const EulerAxes& axes);

/// Finds the angles of rotations about three axes, for many rotations in a row.
class AngleFinder {
 public:
  /// \param start  the first angles shall be near these, in the unit of the angles; 0 if not finite
  AngleFinder(const EulerAxes& axes, bool is_in_degrees, const Vec3& start);

  /// The angles of the next rotations: of all triples for a rotation, the nearest to the previous
  /// triple; NaN for a quaternion that is not finite, which the next triple ignores. In gimbal lock
  /// the first angle keeps its value, as in `euler_angles`.
  /// \param rotations  unit quaternions; in: the rotations; out: unspecified
  void find(simd::Quaternions& rotations, std::size_t count, simd::Angles& angles);

 private:
  Vec3 angles_near(double plus, double minus, double middle) const;
  void find_one(std::size_t i, simd::Angles& angles);

  simd::EulerForm form_;
  simd::Matrix kernel_from_joint_;
  double half_turn_;
  simd::LastTriple last_;
};

}  // namespace kinefile::rotation
