// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "kinefile/array.hpp"
#include "kinefile/diagnostics.hpp"
#include "kinefile/timeline.hpp"
#include "simd/template_rows.hpp"
#include "text/source.hpp"

namespace kinefile {

/// The numbers of a table, row after row, the time first in each; and where the rows start.
struct TableRows {
  std::size_t num_columns = 0;
  Array<double> values;
  std::vector<const char*> starts;
};

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
