// SPDX-License-Identifier: MIT
#pragma once

#include "retime/interpolate_plan.hpp"
#include "retime/interpolate_steps.hpp"

namespace kinefile::retime {

/// Finds the numbers of new frames that would have to be made of numbers that are not finite, and
/// makes them NaN: a number where one that it is made of is such, all angles of a rotation where
/// one of them is.
/// \errors RTM005 if there are any, unless `options.lenient`: then a warning for each joint
Result<void> mark_gaps(const Motion& motion, const std::vector<Step>& steps,
                       const InterpolationPlan& plan, const RetimeOptions& options, Clip& new_clip,
                       Diagnostics& diagnostics);

}  // namespace kinefile::retime
