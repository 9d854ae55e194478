// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "text/printer.hpp"

namespace kinefile::json {

/// Values that JSON has no number for become strings: "nan", "inf", "-inf".
/// \param decimals  as in `simd::NumberSpelling`
inline simd::NumberSpelling number_spelling(std::optional<int> decimals) {
  return {.decimals = decimals, .quotes_non_finite = true};
}

/// Prints numbers as an array.
inline void print_array(text::Printer& printer, std::span<const double> numbers) {
  printer.print('[');
  printer.print_row(numbers, ",");
  printer.print(']');
}

/// Prints `count` elements, separated by commas, as an array.
template <class PrintElement>
void print_elements(text::Printer& printer, std::size_t count, std::string_view separator,
                    const PrintElement& print_element) {
  printer.print('[');
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) printer.print(separator);
    print_element(i);
  }
  printer.print(']');
}

/// Prints an array of many rows of numbers, each on a line of its own.
/// \param print_row  with a printer and the number of the row
template <class PrintRow>
void print_rows(text::Printer& printer, std::size_t num_rows, std::size_t numbers_per_row,
                const PrintRow& print_row) {
  printer.print('[');
  printer.print_rows(num_rows, numbers_per_row,
                     [&](text::Printer& part, std::size_t begin, std::size_t end) {
                       for (std::size_t i = begin; i < end; ++i) {
                         if (i > 0) part.print(",\n  ");
                         print_row(part, i);
                       }
                     });
  printer.print(']');
}

}  // namespace kinefile::json
