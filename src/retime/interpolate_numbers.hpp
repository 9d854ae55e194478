// SPDX-License-Identifier: MIT
#pragma once

#include "retime/interpolate_plan.hpp"
#include "retime/interpolate_steps.hpp"

namespace kinefile::retime {

/// Fills every column of the new rows: copies where a step is whole, else numbers between the two
/// old rows; what is part of a rotation lies near the angles that are looked for then.
void interpolate_rows(const Clip& old_clip, const std::vector<Step>& steps, Clip& new_clip);

/// Puts a curve by Catmull and Rom through columns, one-sided at the ends of the motion.
void curve_columns(const Clip& old_clip, const std::vector<Step>& steps,
                   const std::vector<std::size_t>& columns, Clip& new_clip);

/// Averages columns over the old frames where steps say so.
void average_columns(const Clip& old_clip, const std::vector<Step>& steps,
                     const std::vector<std::size_t>& columns, Clip& new_clip);

}  // namespace kinefile::retime
