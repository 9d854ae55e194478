// SPDX-License-Identifier: MIT
#include "text/number_lines.hpp"

#include <algorithm>

#include "simd/number_rows.hpp"
#include "text/numbers.hpp"

namespace kinefile::text {

NumberLines read_number_lines(const char* begin, const char* end, std::size_t num_columns,
                              std::size_t max_rows, double* out) {
  constexpr std::size_t kMostLines = 64;
  NumberLines lines{0, begin};
  // Where the vector reader finds nothing, it is asked the less often, so that no byte is looked at
  // many times.
  std::size_t num_lines = 1, num_lines_left = 0;
  while (lines.next != end && lines.num_rows < max_rows) {
    double* const row = out + lines.num_rows * num_columns;
    if (num_lines_left-- == 0) {
      const simd::NumberRows read =
          simd::read_number_rows(lines.next, end, num_columns, max_rows - lines.num_rows, row);
      num_lines = read.num_rows == 0 ? std::min(2 * num_lines, kMostLines) : 1;
      num_lines_left = num_lines;
      lines.num_rows += read.num_rows;
      lines.next = read.next;
      continue;
    }
    const NumberRow line = read_number_row(lines.next, end, row, num_columns);
    const bool is_row = line.count == num_columns;
    if (line.end != RowEnd::EndOfLine || (!is_row && line.count != 0)) return lines;
    lines.num_rows += is_row ? 1 : 0;
    lines.next = line.next;
  }
  return lines;
}

}  // namespace kinefile::text
