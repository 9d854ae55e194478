// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "kinefile/diagnostics.hpp"
#include "kinefile/timeline.hpp"
#include "text/source.hpp"

namespace kinefile {

/// The numbers of a table, row after row, the time first in each; and where the rows start.
struct TableRows {
  std::size_t num_columns = 0;
  std::vector<double> values;
  std::vector<const char*> starts;
};

/// The codes of what `timeline_of_rows` says.
struct TableTimeCodes {
  const char* not_rising;  ///< an error: a time that is not above the one before, or not finite
  const char* no_rate;     ///< a note: fewer than two rows
  const char* late_start;  ///< a note: the first time is not 0, and times count from 0
};

/// The rate that a table's times tell, a whole one where it is within a ten-thousandth of it or
/// where the times are its frames' rounded to their last digits; the times themselves where they
/// are at no steady rate. Empty after an error. \param fps  what the caller says it is; the times
/// then count no more
std::optional<Timeline> timeline_of_rows(const text::Source& source, const TableRows& rows,
                                         std::optional<double> fps, const TableTimeCodes& codes,
                                         Diagnostics& diagnostics);

}  // namespace kinefile
