// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string_view>

#include "text/printer.hpp"

namespace kinefile::json {

/// Prints a number; values that JSON has no number for become strings: "nan", "inf", "-inf".
inline void print_number(text::Printer& printer, double number) {
  const bool is_number = std::isfinite(number);
  if (!is_number) printer.print('"');
  printer.print(number);
  if (!is_number) printer.print('"');
}

/// Prints numbers as an array.
template <class Numbers>
void print_array(text::Printer& printer, const Numbers& numbers) {
  printer.print('[');
  bool is_first = true;
  for (const double number : numbers) {
    if (!is_first) printer.print(',');
    is_first = false;
    print_number(printer, number);
  }
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

}  // namespace kinefile::json
