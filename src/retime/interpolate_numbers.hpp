// SPDX-License-Identifier: MIT
#pragma once

#include "retime/interpolate_plan.hpp"
#include "retime/interpolate_steps.hpp"

namespace kinefile::retime {

/// Fills every column of the new rows: copies if a step is whole, otherwise numbers between the two
/// old rows. In columns of rotations these are start values, near which the angles are found later.
void interpolate_rows(const Clip& old_clip, const std::vector<Step>& steps, Clip& new_clip);

/// Interpolates columns by a Catmull-Rom curve, one-sided at the ends of the motion.
void curve_columns(const Clip& old_clip, const std::vector<Step>& steps,
                   const std::vector<std::size_t>& columns, Clip& new_clip);

/// Averages columns over old frames, for steps with an average.
void average_columns(const Clip& old_clip, const std::vector<Step>& steps,
                     const std::vector<std::size_t>& columns, Clip& new_clip);

}  // namespace kinefile::retime
