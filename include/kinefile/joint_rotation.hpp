// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kinefile/skeleton.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// The rotations of a joint: its single-axis rotations, outermost first, or its one ball or
/// rotation vector; for a free joint its quaternion, as a ball.
std::vector<DegreeOfFreedom> rotations_of(const Joint& joint);

/// Whether a joint's rotations are a whole rotation: a ball or a rotation vector, whose several
/// columns can hold every rotation.
bool is_whole_rotation(const std::vector<DegreeOfFreedom>& rotations);

/// The axes of a joint's rotations, outermost first, if they are three that can represent every
/// rotation (see `euler_angles`).
std::optional<EulerAxes> euler_axes_of(const std::vector<DegreeOfFreedom>& rotations);

/// Whether a joint's rotations can represent every rotation.
bool can_turn_in_any_way(const std::vector<DegreeOfFreedom>& rotations);

/// The product of rotations in one row of a clip: the joint's rotation without its rest rotation.
/// A quaternion is normalised.
/// \param rotations  of `rotations_of`
Mat3 rotation_in_row(const std::vector<DegreeOfFreedom>& rotations, std::span<const double> row,
                     AngleUnit unit);

/// As `rotation_in_row`, but a unit quaternion. A whole rotation is read without conversion to a
/// matrix.
Quat quaternion_in_row(const std::vector<DegreeOfFreedom>& rotations, std::span<const double> row,
                       AngleUnit unit);

/// The product of a joint's rotations in the rest pose.
Quat rotation_at_rest(const Joint& joint, AngleUnit unit);

/// The unit quaternion that the columns of a whole rotation (see `is_whole_rotation`) hold.
Quat whole_rotation_in_row(const DegreeOfFreedom& dof, std::span<const double> row, AngleUnit unit);

/// Writes a rotation to the columns of a whole rotation (see `is_whole_rotation`): a quaternion
/// with the sign, a rotation vector with the number of turns, that is nearest to the numbers in the
/// row.
/// \param row  in: what the new numbers shall be near; out: the new ones
void set_whole_rotation(const DegreeOfFreedom& dof, const Quat& rotation, AngleUnit unit,
                        std::span<double> row);

/// Finds the values of a joint's degrees of freedom for a rotation: exactly if these are three (see
/// `euler_axes_of`) or a whole rotation, otherwise as near as possible, by least squares.
/// \param rotations  of `rotations_of`
/// \param rotation   without the joint's rest rotation
/// \param row        in: the numbers that the new ones shall be near; out: the new ones. Other
///                   columns stay unchanged
/// \param follows    rotations that keep their values; shape (rotations), or empty for none
/// \returns          the residual angle between `rotation` and the fitted one, in radians
double fit_rotation(const std::vector<DegreeOfFreedom>& rotations, const Mat3& rotation,
                    AngleUnit unit, std::span<double> row, const std::vector<bool>& follows = {});

}  // namespace kinefile

#pragma GCC visibility pop
