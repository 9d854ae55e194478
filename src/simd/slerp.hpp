// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "simd/block.hpp"

namespace kinefile::simd {

/// Vectors of `kSize` numbers, one array per component: [component][vector]. The length of the
/// arrays is a multiple of kBlock (see `padded`); the padding is unspecified.
template <std::size_t kSize>
using Components = std::array<std::vector<double>, kSize>;

using Angles = Components<3>;
using Quaternions = Components<4>;  ///< w x y z

/// The next multiple of kBlock.
constexpr std::size_t padded(std::size_t count) { return (count + kBlock - 1) / kBlock * kBlock; }

/// Three axes that can represent every rotation (see `euler_angles`), in the form that the kernel
/// needs. In the basis of the first, the second and their cross product, the rotation is Rx(a)
/// Ry(b) Rx(sign c) (proper Euler) or Rx(a) Ry(b) Rz(sign c) (Tait-Bryan); the latter is Rx(a) Ry(b
/// - 90 degrees) Rx(sign c), times a constant. So one formula covers all axes:
///     w = cos(b'/2) cos(p)   x = cos(b'/2) sin(p)   y = sin(b'/2) cos(m)   z = sin(b'/2) sin(m)
/// with b' = b - shift, p = (a + sign c) / 2, m = (a - sign c) / 2.
/// These quaternions are the joint's own up to constant factors on the left and on the right, which
/// do not affect interpolation of rotations.
/// Source: Bernardes and Viollet, "Quaternion to Euler angles conversion", PLOS ONE 17 (2022).
struct EulerForm {
  double sign = 1;
  double shift = 0;  ///< in the unit of the angles
  bool is_in_degrees = true;
};

/// The quaternions of angles.
void quaternions_of_angles(const EulerForm& form, const Angles& angles, Quaternions& quaternions);

/// The angles of quaternions of any length, nearest to given angles. In gimbal lock, where only a
/// sum or a difference of the outer angles is known, the other keeps its given value.
/// \param angles  in: the angles shall be near these; out: the angles
void angles_of_quaternions(const EulerForm& form, const Quaternions& quaternions, Angles& angles);

/// The half angles of quaternions of any length: (a + sign c) / 2, (a - sign c) / 2 and b - shift,
/// the last from 0 to half a turn. At both ends of that range, in gimbal lock, one of the other two
/// is undefined.
/// \param halves  out, in the unit of the angles
void half_angles_of_quaternions(const EulerForm& form, const Quaternions& quaternions,
                                Angles& halves);

/// A place between two quaternions.
struct Between {
  std::size_t from;
  std::size_t to;
  double t;  ///< 0 at `from`, 1 at `to`
};

/// Interpolates between unit quaternions as `kinefile::slerp` and `kinefile::nlerp` do; the results
/// are not normalised.
/// \param places  padded to a multiple of kBlock
void slerp(const Quaternions& quaternions, const std::vector<Between>& places, Quaternions& out);
void nlerp(const Quaternions& quaternions, const std::vector<Between>& places, Quaternions& out);

/// The quaternions before and after one on a curve, or itself if there is none.
struct Neighbours {
  std::size_t before;
  std::size_t after;
};

/// The inner control points of a curve through unit quaternions, as `kinefile::squad_control` finds
/// them; the quaternion itself if a neighbour is missing.
/// \param neighbours  of each quaternion, padded
void squad_controls(const Quaternions& quaternions, const std::vector<Neighbours>& neighbours,
                    Quaternions& controls);

/// Interpolates on a curve as `kinefile::squad` does; the results are not normalised.
void squad(const Quaternions& quaternions, const Quaternions& controls,
           const std::vector<Between>& places, Quaternions& out);

/// The angle of a point (x, y) as the kernel computes it, for arrays padded to a multiple of
/// kBlock. For numbers far from the limits of the range of doubles; within 2 units in the last
/// place.
void atan2(const std::vector<double>& y, const std::vector<double>& x, std::vector<double>& angles);

}  // namespace kinefile::simd
