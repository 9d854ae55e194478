// SPDX-License-Identifier: MIT
#include "text/number_lines.hpp"

#include "simd/number_rows.hpp"
#include "text/attempts.hpp"
#include "text/numbers.hpp"

namespace kinefile::text {

simd::NumberRows read_number_lines(const char* begin, const char* end, std::size_t num_columns,
                                   std::size_t max_rows, double* out, const char** starts) {
  simd::NumberRows lines{0, begin};
  Attempts attempts;
  while (lines.next != end && lines.num_rows < max_rows) {
    double* const row = out + lines.num_rows * num_columns;
    const char** const start = starts == nullptr ? nullptr : starts + lines.num_rows;
    if (attempts.is_due()) {
      const simd::NumberRows read = simd::read_number_rows(lines.next, end, num_columns,
                                                           max_rows - lines.num_rows, row, start);
      attempts.made(read.num_rows > 0);
      lines.num_rows += read.num_rows;
      lines.next = read.next;
      continue;
    }
    const NumberRow line = read_number_row(lines.next, end, row, num_columns);
    const bool is_row = line.count == num_columns;
    if (line.end != RowEnd::EndOfLine || (!is_row && line.count != 0)) return lines;
    if (is_row && start != nullptr) *start = lines.next;
    lines.num_rows += is_row ? 1 : 0;
    lines.next = line.next;
  }
  return lines;
}

}  // namespace kinefile::text
