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
#include "text/row_pieces.hpp"
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
  std::vector<double> half_digits;  ///< of each time, see `half_of_last_digit`
  std::vector<const char*> starts;  ///< of each row's text
  std::vector<TablePart> parts;

  /// Adds a part for some columns, before there are rows.
  void add_part(std::span<const std::size_t> columns);
  /// Appends a row to all parts.
  /// \param start, end  of its text, which may go on behind the row
  void append(std::span<const double> row, const char* start, const char* end);
};

/// Appends rows of a text in memory, as far as they go, after one or more that are there already.
/// \returns  the first row that is another, or the end
const char* append_rows(const char* begin, const char* end, const text::RowReader& reader,
                        TableRows& rows);

/// Appends the rows of a file from a place to its end, after one or more that are there already.
/// Their texts are not kept: for messages all of them start at the same place.
/// \returns  false if some text is no row, or cannot be read
bool append_rows(const ByteSource& bytes, std::size_t offset, const text::RowReader& reader,
                 const char* start, TableRows& rows);

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
