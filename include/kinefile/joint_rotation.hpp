// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kinefile/skeleton.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// The rotations among a joint's degrees of freedom, outermost first.
std::vector<DegreeOfFreedom> rotations_of(const Joint& joint);

/// The axes of a joint's rotations, outermost first, if they are three from which every rotation
/// can be made and to which it can be brought back (see `euler_angles`).
std::optional<EulerAxes> euler_axes_of(const std::vector<DegreeOfFreedom>& rotations);

/// The product of rotations in one row of a clip: the joint's rotation without its rest rotation.
/// \param rotations  outermost first
Mat3 rotation_in_row(const std::vector<DegreeOfFreedom>& rotations, std::span<const double> row,
                     AngleUnit unit);

/// Brings a rotation back to the degrees of freedom of a joint: exactly where these are three (see
/// `euler_axes_of`), else as near as they come, by least squares.
/// \param rotations  outermost first
/// \param rotation   without the joint's rest rotation
/// \param row        in: the angles that the new ones are to be near; out: the new ones. Other
///                   columns are left alone
/// \returns          the angle that is left between `rotation` and what was reached, in radians
double fit_rotation(const std::vector<DegreeOfFreedom>& rotations, const Mat3& rotation,
                    AngleUnit unit, std::span<double> row);

}  // namespace kinefile

#pragma GCC visibility pop
