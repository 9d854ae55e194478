// SPDX-License-Identifier: MIT
#include "kinematics/column_range.hpp"

#include <cmath>

namespace kinefile {
namespace {

void extend(ColumnRange& range, double number) {
  if (range.num_frames++ == 0) range.first = number;
  range.is_constant = range.is_constant && number == range.first;  // NaN never is
  range.is_finite = range.is_finite && std::isfinite(number);
  if (number < range.least) range.least = number;
  if (number > range.greatest) range.greatest = number;
}

}  // namespace

Result<ColumnRanges> ranges_of_columns(EachBlock frames, std::size_t num_coordinates,
                                       const std::vector<std::size_t>& columns) {
  ColumnRanges ranges;
  for (const std::size_t column : columns) ranges[column];
  if (ranges.empty()) return ranges;
  auto read = frames([&](const FrameBlock& block) {
    for (std::size_t f = 0; f < block.num_frames; ++f) {
      const auto row = block.rows.subspan(f * num_coordinates, num_coordinates);
      for (auto& [column, range] : ranges) extend(range, row[column]);
    }
    return true;
  });
  if (!read) return fail(std::move(read.error()));
  return ranges;
}

ColumnRange range_of_column(const Clip& clip, std::size_t column) {
  ColumnRange range;
  for (std::size_t f = 0; f < clip.num_frames; ++f) extend(range, clip.row(f)[column]);
  return range;
}

bool is_always(const ColumnRange& range, double value) {
  return range.num_frames == 0 || (range.is_constant && range.first == value);
}

double farthest_from(const ColumnRange& range, double value) {
  if (!(range.least <= range.greatest)) return 0;
  return std::fmax(std::abs(range.least - value), std::abs(range.greatest - value));
}

}  // namespace kinefile
