// SPDX-License-Identifier: MIT
#pragma once

#include "retime/interpolate_plan.hpp"
#include "retime/interpolate_steps.hpp"

namespace kinefile::retime {

/// Fills the columns of rotations in the new rows whose steps are not copies.
/// \param new_clip  in: angles that the new ones shall be near; out: the new ones
void interpolate_rotations(const Clip& old_clip, const std::vector<Step>& steps,
                           const InterpolationPlan& plan, RotationInterpolation rotation,
                           Clip& new_clip);

}  // namespace kinefile::retime
