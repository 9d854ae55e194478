// SPDX-License-Identifier: MIT
#pragma once

#include "retime/interpolate_plan.hpp"
#include "retime/interpolate_steps.hpp"

namespace kinefile::retime {

/// Finds the numbers of new frames whose inputs are not finite, and sets them to NaN; for a
/// rotation all of its angles.
/// \errors RTM005 if there are any, unless `options.lenient`: then a warning for each joint
Result<void> mark_gaps(const Motion& motion, const std::vector<Step>& steps,
                       const InterpolationPlan& plan, const RetimeOptions& options, Clip& new_clip,
                       Diagnostics& diagnostics);

}  // namespace kinefile::retime
