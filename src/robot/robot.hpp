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

/// The angle about an axis that comes nearest to a rotation, on the turn that is nearest to
/// another.
double angle_about(const Quat& q, const Vec3& axis, double near);

/// Finds the displacements of joints from the poses of all links: the turn about a joint's axis, or
/// the way along it, that comes nearest. Turns go on from the frame before.
/// \param posed  of `pose`; its joints' columns are set (see `value_columns`)
void find_joints(const Component& links, Motion& posed);

/// Compares what was recorded of following joints with what they have by following.
/// \errors BRG017 (DataLoss) if they differ by more than rounding and not `lenient`, which lets the
/// joints follow and warns
Result<void> settle_following_columns(Motion& motion, bool lenient, Diagnostics& diagnostics);

}  // namespace kinefile::robot
