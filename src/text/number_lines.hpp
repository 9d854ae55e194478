// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "simd/number_rows.hpp"

namespace kinefile::text {

/// Reads lines of numbers that are separated by blanks, exact to the last bit, up to the first line
/// that is neither a row of plain finite numbers nor empty. Does not allocate for each line.
/// \param begin        where a line begins, or its rest after the last token that was read
/// \param end          the end of the text, which also ends the line
/// \param num_columns  of a row, at least 1
/// \param max_rows     reading stops after as many rows
/// \param out          room for these; what lies behind the rows that were read is unspecified
/// \param starts       out: where each row begins; room for `max_rows`; null: not wanted
simd::NumberRows read_number_lines(const char* begin, const char* end, std::size_t num_columns,
                                   std::size_t max_rows, double* out,
                                   const char** starts = nullptr);

}  // namespace kinefile::text
