// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "kinefile/body_motion.hpp"
#include "kinefile/math.hpp"
#include "kinefile/motion.hpp"
#include "kinefile/result.hpp"

namespace kinefile::robot {

/// The rotation of a recorded pose, of unit length.
Quat rotation_of(const Component& links, std::span<const double> pose);

/// The angle about an axis that is nearest to a rotation, plus whole turns so that it is nearest to
/// another angle.
double angle_about(const Quat& q, const Vec3& axis, double near);

/// Finds the displacements of joints from the poses of all links: the rotation about a joint's
/// axis, or the translation along it, with the smallest residual. Angles are nearest to the
/// previous frame.
/// \param posed   of `pose`; its joints' columns are set (see `value_columns`)
void find_joints(const Component& links, Motion& posed);

/// Compares the recorded values of joints that follow others with the values that they have by
/// following.
/// \errors BRG017 (DataLoss) if they differ by more than rounding and not `lenient`, which ignores
///         the recorded values and warns
Result<void> settle_following_columns(Motion& motion, bool lenient, Diagnostics& diagnostics);

}  // namespace kinefile::robot
