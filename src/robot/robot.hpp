// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "kinefile/body_motion.hpp"
#include "kinefile/math.hpp"
#include "kinefile/motion.hpp"

namespace kinefile::robot {

/// The rotation of a recorded pose, of unit length.
Quat rotation_of(const Component& links, std::span<const double> pose);

/// The angle about an axis that comes nearest to a rotation, on the turn that is nearest to
/// another.
double angle_about(const Quat& q, const Vec3& axis, double near);

/// Finds the displacements of joints from the poses of all links: the turn about a joint's axis, or
/// the way along it, that comes nearest. Turns go on from the frame before.
/// \param posed  of `pose`; its joints' columns are set
void find_joints(const Component& links, Motion& posed);

}  // namespace kinefile::robot
