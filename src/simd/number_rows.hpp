// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace kinefile::simd {

/// How far rows were read.
struct NumberRows {
  std::size_t num_rows = 0;
  const char* next = nullptr;  ///< the beginning of the first line that is not one of these rows
};

/// What separates the numbers of a row.
enum class Separator {
  Blanks,  ///< spaces and tabs
  Comma,   ///< one comma
};

/// Reads lines that hold the same number of numbers, exact to the last bit, until one that is not
/// plain: a line of another number of tokens, an empty one, one without a line end, or one with a
/// token that is not a finite number of decimal digits with an optional sign, point and exponent.
/// What it stops at is for another reader to read or to refuse; it may as well read on behind that.
/// Lines end with LF or CR LF.
/// \param begin        the beginning of a line
/// \param end          where the text ends
/// \param num_columns  numbers in a line, 1 or more
/// \param max_rows     where to stop
/// \param out          room for `max_rows` rows; shape (max_rows, num_columns). What stands behind
///                     the rows that were read is not defined.
/// \param rows         out: where each row begins; room for `max_rows`; null: not wanted
NumberRows read_number_rows(const char* begin, const char* end, std::size_t num_columns,
                            std::size_t max_rows, double* out, const char** rows = nullptr,
                            Separator separator = Separator::Blanks);

}  // namespace kinefile::simd
