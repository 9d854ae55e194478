// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <vector>

#include "kinefile/frame_source.hpp"

namespace kinefile {

/// What all frames of a motion show of a column: as much as decisions about it need, so that the
/// frames need not be in memory.
struct ColumnRange {
  std::size_t num_frames = 0;
  double first = 0;         ///< the number of the first frame
  bool is_constant = true;  ///< every frame has that number
  bool is_finite = true;
  double least = std::numeric_limits<double>::infinity();  ///< of the numbers that are not NaN
  double greatest = -std::numeric_limits<double>::infinity();
};

/// By column.
using ColumnRanges = std::map<std::size_t, ColumnRange>;

/// The ranges of some columns over all frames; reads no frames if there are no columns.
/// \param num_coordinates  how many numbers a row has
/// \errors those of `frames`
Result<ColumnRanges> ranges_of_columns(EachBlock frames, std::size_t num_coordinates,
                                       const std::vector<std::size_t>& columns);

/// The range of a column of a clip.
ColumnRange range_of_column(const Clip& clip, std::size_t column);

/// Whether a column equals `value` in every frame, as `is_always` says of a clip.
bool is_always(const ColumnRange& range, double value);

/// How far a column is from a value at the most, NaN left aside.
double farthest_from(const ColumnRange& range, double value);

}  // namespace kinefile
