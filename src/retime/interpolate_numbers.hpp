// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "retime/interpolate_plan.hpp"
#include "retime/interpolate_steps.hpp"

namespace kinefile::retime {

/// A column that is interpolated as numbers. From frame to frame an angle takes the short way
/// round, whatever its numbers are.
struct NumberColumn {
  std::size_t index = 0;
  double turn = 0;                 ///< the period of an angle; 0 for other numbers
  std::vector<double> turns = {};  ///< the whole turns that an angle has jumped back until each
                                   ///< old frame; empty if it never jumps
};

/// The columns of a plan that are interpolated as numbers, with the turns of their angles. Frames
/// with numbers that are not finite are passed over.
std::vector<NumberColumn> number_columns_of(const Clip& old_clip, const InterpolationPlan& plan);

/// Fills every column of the new rows: copies if a step is whole, otherwise numbers between the two
/// old rows. In columns of rotations these are start values, near which the angles are found later.
/// Angles that jump are not between the two numbers, see `turn_columns`.
void interpolate_rows(const Clip& old_clip, const std::vector<Step>& steps, Clip& new_clip);

/// Interpolates the columns whose angles jump.
void turn_columns(const Clip& old_clip, const std::vector<Step>& steps,
                  const std::vector<NumberColumn>& columns, Clip& new_clip);

/// Interpolates columns by a Catmull-Rom curve, one-sided at the ends of the motion.
void curve_columns(const Clip& old_clip, const std::vector<Step>& steps,
                   const std::vector<NumberColumn>& columns, Clip& new_clip);

/// Averages columns over old frames, for steps with an average.
void average_columns(const Clip& old_clip, const std::vector<Step>& steps,
                     const std::vector<NumberColumn>& columns, Clip& new_clip);

}  // namespace kinefile::retime
