// SPDX-License-Identifier: MIT
#include "text/print_rows.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "base/parallel.hpp"
#include "kinefile/threads.hpp"

namespace kinefile::text {
namespace {

/// A part of which the text fits in a core's second cache.
constexpr std::size_t kNumbersPerPart = std::size_t{1} << 15;

bool print_all(std::size_t num_rows, const simd::NumberSpelling& spelling, const PrintRows& print,
               const std::function<bool(std::string_view)>& sink) {
  Printer printer(sink, spelling);
  print(printer, 0, num_rows);
  return printer.finish();
}

}  // namespace

bool print_rows(std::size_t num_rows, std::size_t numbers_per_row,
                const simd::NumberSpelling& spelling, const PrintRows& print,
                const std::function<bool(std::string_view)>& sink) {
  const std::size_t part =
      std::max<std::size_t>(kNumbersPerPart / std::max<std::size_t>(numbers_per_row, 1), 1);
  const std::size_t count = num_rows / part + (num_rows % part == 0 ? 0 : 1);
  const std::size_t num_slots = slots_for_threads();
  if (!kHasThreads || count < 2 || num_slots < 2 || max_threads() < 2) {
    return print_all(num_rows, spelling, print, sink);
  }
  std::vector<std::string> texts(std::min(count, num_slots));
  const auto make = [&](std::size_t i, std::size_t slot) {
    std::string& text = texts[slot];
    text.clear();
    const std::function<bool(std::string_view)> append = [&text](std::string_view piece) {
      text += piece;
      return true;
    };
    Printer printer(append, spelling);
    print(printer, i * part, std::min((i + 1) * part, num_rows));
    printer.finish();
  };
  return make_in_order(count, texts.size(), make,
                       [&](std::size_t, std::size_t slot) { return sink(texts[slot]); });
}

}  // namespace kinefile::text
