// SPDX-License-Identifier: MIT
// Rotations of one joint in many frames: from angles in rows to quaternions, and back to angles.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "simd/block.hpp"
#include "simd/forward_kinematics.hpp"

namespace kinefile::simd {

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

/// The products of turns in some rows.
/// \param turns  outermost first
/// \param out    unit quaternions
void products_of_turns(std::span<const Turn> turns, bool is_in_degrees, const Rows& rows,
                       Quaternions& out);

/// Rotates the axes of rotations: the results have the same angles about axes transformed by a
/// matrix.
/// \param turn  a rotation, or the negative of a reflection
void turn_axes(const Matrix& turn, Quaternions& quaternions);

/// Converts rotations to the form of `EulerForm`; they are not normalised.
/// \param kernel_from_joint  the basis of the axes
void turn_to_form(const EulerForm& form, const Matrix& kernel_from_joint, Quaternions& quaternions);

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

/// Where a row of triples ends that follow each other.
struct LastTriple {
  std::array<double, 3> angles{};
  bool is_second = false;  ///< the middle angle is shift minus what `half_angles_of_quaternions`
                           ///< finds
};

/// Replaces half angles by triples of angles, each the nearest to the one before it of all triples
/// for its rotation. Goes on as long as that is plain: all triples of a block are first ones or all
/// are second ones, none is in gimbal lock, and no other triple is nearly as near. Then the numbers
/// are those that the rule gives one by one, bit for bit.
/// \param first   a multiple of kBlock
/// \param count   of all rotations
/// \param last    in and out: the triple before `first`, and that before the result
/// \param angles  in: half angles; out: triples before the result
/// \returns       the first rotation of the block that is not plain, or `count`
std::size_t follow_triples(const EulerForm& form, std::size_t first, std::size_t count,
                           LastTriple& last, Angles& angles);

/// The angle of a point (x, y) as the kernel computes it, for arrays padded to a multiple of
/// kBlock. For numbers far from the limits of the range of doubles; within 2 units in the last
/// place.
void atan2(const std::vector<double>& y, const std::vector<double>& x, std::vector<double>& angles);

}  // namespace kinefile::simd
