// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace kinefile {

/// No column: a file does not have this value.
inline constexpr std::size_t kNoColumn = std::numeric_limits<std::size_t>::max();

/// Consecutive numbers of a list that are consecutive columns of a row.
struct ColumnRun {
  std::size_t place = 0;   ///< of the first one in the list
  std::size_t column = 0;  ///< likewise in the row; `kNoColumn`: of a number without a column
  std::size_t count = 0;
};

/// The runs of a list of columns, so that numbers are moved many at once.
inline std::vector<ColumnRun> column_runs(std::span<const std::size_t> columns) {
  std::vector<ColumnRun> runs;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const bool goes_on = !runs.empty() && runs.back().column != kNoColumn &&
                         runs.back().column + runs.back().count == columns[i];
    if (goes_on) {
      ++runs.back().count;
    } else {
      runs.push_back({i, columns[i], 1});
    }
  }
  return runs;
}

/// Copies the numbers of a row to a list; without a column they are 0.
inline void take_columns(std::span<const ColumnRun> runs, const double* row, double* list) {
  for (const ColumnRun& run : runs) {
    if (run.column == kNoColumn) {
      list[run.place] = 0;
    } else {
      std::copy_n(row + run.column, run.count, list + run.place);
    }
  }
}

/// Copies a list of numbers, all of which have columns, to a row.
inline void put_in_columns(std::span<const ColumnRun> runs, const double* list, double* row) {
  for (const ColumnRun& run : runs) std::copy_n(list + run.place, run.count, row + run.column);
}

}  // namespace kinefile
