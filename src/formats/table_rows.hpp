// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "formats/column_runs.hpp"
#include "kinefile/array.hpp"
#include "kinefile/diagnostics.hpp"
#include "kinefile/timeline.hpp"
#include "simd/template_rows.hpp"
#include "text/source.hpp"

namespace kinefile {

/// The numbers of some columns of a table, row after row.
struct TablePart {
  std::vector<ColumnRun> columns;
  std::size_t width = 0;
  Array<double> values;
};

/// The rows of a table, each of which begins with its time.
struct TableRows {
  std::size_t num_columns = 0;
  std::vector<double> times;
  std::vector<const char*> starts;
  std::vector<TablePart> parts;

  /// Adds a part for some columns, before there are rows.
  void add_part(std::span<const std::size_t> columns);
  /// Appends a row to all parts.
  /// \param start  of its text
  void append(std::span<const double> row, const char* start);
};

/// Appends rows of numbers between blanks, as far as they go (see `simd::read_number_rows`).
/// \returns  the first row that is another, or the end
const char* append_number_rows(const char* begin, const char* end, TableRows& rows);

/// Appends rows that have the text of the first row between their numbers, as far as they go.
/// \param row  the template of the first row
/// \returns    the first row that is another, or the end
const char* append_like_rows(const char* begin, const char* end, const simd::RowTemplate& row,
                             TableRows& rows);

/// The codes of the messages of `timeline_of_rows`.
struct TableTimeCodes {
  const char* not_rising;  ///< an error: a time that is not above the one before, or not finite
  const char* no_rate;     ///< a note: fewer than two rows
  const char* late_start;  ///< a note: the first time is not 0; times are counted from 0
  const char* gap;         ///< a note: rows are missing at a place
  const char* slow;        ///< a note: a second or more from row to row
};

/// The rate from a table's times (see `rate_of_times`). It is a whole number if it is within a
/// ten-thousandth of one, or if the times are those of its frames rounded to their last digits.
/// Without a steady rate, the times themselves. Empty after an error.
/// \param fps  the rate that the caller specifies; then the times are not used
std::optional<Timeline> timeline_of_rows(const text::Source& source, const TableRows& rows,
                                         std::optional<double> fps, const TableTimeCodes& codes,
                                         Diagnostics& diagnostics);

}  // namespace kinefile
