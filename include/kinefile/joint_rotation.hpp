// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kinefile/skeleton.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// What turns a joint: its rotations, outermost first, or its one ball or rotation vector; of a
/// free joint its quaternion, as a ball.
std::vector<DegreeOfFreedom> rotations_of(const Joint& joint);

/// Whether a joint's rotations are one that several columns tell as a whole: a ball or a rotation
/// vector, which every rotation can be written to.
bool is_whole_rotation(const std::vector<DegreeOfFreedom>& rotations);

/// The axes of a joint's rotations, outermost first, if they are three from which every rotation
/// can be made and to which it can be brought back (see `euler_angles`).
std::optional<EulerAxes> euler_axes_of(const std::vector<DegreeOfFreedom>& rotations);

/// Whether every rotation can be brought back to a joint's rotations.
bool can_turn_in_any_way(const std::vector<DegreeOfFreedom>& rotations);

/// The product of rotations in one row of a clip: the joint's rotation without its rest rotation.
/// A quaternion is normalised.
/// \param rotations  of `rotations_of`
Mat3 rotation_in_row(const std::vector<DegreeOfFreedom>& rotations, std::span<const double> row,
                     AngleUnit unit);

/// The same as a unit quaternion, which is where the joint has it as such.
Quat quaternion_in_row(const std::vector<DegreeOfFreedom>& rotations, std::span<const double> row,
                       AngleUnit unit);

/// The product of a joint's rotations in the rest pose.
Quat rotation_at_rest(const Joint& joint, AngleUnit unit);

/// The rotation that the columns of a whole rotation (see `is_whole_rotation`) tell, of unit
/// length.
Quat whole_rotation_in_row(const DegreeOfFreedom& dof, std::span<const double> row, AngleUnit unit);

/// Writes a rotation to the columns of a whole rotation (see `is_whole_rotation`): a quaternion
/// with the sign, a rotation vector on the turn that is nearest to the numbers in the row. \param
/// row  in: what the new numbers are to be near; out: the new ones
void set_whole_rotation(const DegreeOfFreedom& dof, const Quat& rotation, AngleUnit unit,
                        std::span<double> row);

/// Brings a rotation back to the degrees of freedom of a joint: exactly where these are three (see
/// `euler_axes_of`) or a whole rotation, else as near as they come, by least squares.
/// \param rotations  of `rotations_of`
/// \param rotation   without the joint's rest rotation
/// \param row        in: the numbers that the new ones are to be near; out: the new ones. Other
///                   columns are left alone
/// \param follows    rotations that stay as they are; shape (rotations), or empty for none
/// \returns          the angle that is left between `rotation` and what was reached, in radians
double fit_rotation(const std::vector<DegreeOfFreedom>& rotations, const Mat3& rotation,
                    AngleUnit unit, std::span<double> row, const std::vector<bool>& follows = {});

}  // namespace kinefile

#pragma GCC visibility pop
