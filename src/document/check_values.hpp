// SPDX-License-Identifier: MIT
// What `check` finds in the numbers of a document. No format forbids it, and only a person knows
// whether it is meant: all are notes, but for components that do not fit together.
#pragma once

#include "kinefile/body_motion.hpp"
#include "kinefile/diagnostics.hpp"
#include "kinefile/motion.hpp"

namespace kinefile {

/// Notes joints that jump (MOT006) and degrees that look like radians (MOT009).
void check_values(const Motion& motion, Diagnostics& diagnostics);

/// Tells of components that differ in length or rate (BRG021), and notes links that jump (MOT006)
/// or are far away, as if in millimetres (MOT008).
/// \param has_robot  whether the values are checked against a robot's limits, too; otherwise joints
///                   beyond a full turn are noted, as if in degrees (MOT007)
void check_values(const BodyMotion& body, bool has_robot, Diagnostics& diagnostics);

}  // namespace kinefile
