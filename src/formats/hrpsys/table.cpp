// SPDX-License-Identifier: MIT
#include "formats/hrpsys/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "formats/hrpsys/codes.hpp"
#include "text/attempts.hpp"
#include "text/numbers.hpp"
#include "text/scanner.hpp"

namespace kinefile::hrpsys {
namespace {

/// The number of values that are read at a time.
constexpr std::size_t kPiece = 256;

struct TableParser {
  const text::Source& source;
  Diagnostics& diagnostics;

  void error(const char* code, std::string message, const char* at) {
    text::report(source, diagnostics, Severity::Error, code, std::move(message), at);
  }

  /// Reads the numbers of a line.
  /// \returns the start of the next line; null after an error
  const char* parse_row(const char* p, std::vector<double>& values) {
    std::array<double, kPiece> piece;
    values.clear();
    while (true) {
      const text::NumberRow row = text::read_number_row(p, source.end(), piece.data(), kPiece);
      values.insert(values.end(), piece.begin(), piece.begin() + row.count);
      p = row.next;
      if (row.end == text::RowEnd::EndOfLine) return p;
      if (row.end == text::RowEnd::Full) continue;
      text::Scanner scanner(std::string_view(p, static_cast<std::size_t>(source.end() - p)));
      const std::string_view token = scanner.take_in_line();
      const text::Number number = text::parse_number(token);  // nan and inf, too
      if (number.fault != text::NumberFault::None) {
        error(code::kNotANumber, fmt::format("expected a number, found {}", text::quoted(token)),
              p);
        return nullptr;
      }
      // The time is checked with the other times.
      if (!std::isfinite(number.value) && !values.empty()) {
        text::report(source, diagnostics, Severity::Warning, code::kNotFinite,
                     fmt::format("expected a finite number, found {}", text::quoted(token)),
                     token.data());
      }
      values.push_back(number.value);
      p = scanner.position();
    }
  }

  /// Makes one part of all columns but the time's.
  static void start_rows(std::size_t num_columns, TableRows& rows) {
    rows.num_columns = num_columns;
    std::vector<std::size_t> columns(num_columns - 1);
    std::iota(columns.begin(), columns.end(), 1);
    rows.add_part(columns);
  }

  bool parse_rows(TableRows& rows) {
    const char* p = source.text().data();
    text::RowReader reader;
    std::vector<double> values;
    text::Attempts attempts;
    while (p != source.end()) {
      if (simd::kReadsTemplateRows && !rows.starts.empty() && attempts.is_due()) {
        const char* const next = append_rows(p, source.end(), reader, rows);
        attempts.made(next != p);
        p = next;
        continue;
      }
      const char* const start = p;
      const char* const first = std::find_if_not(p, source.end(), text::is_blank);
      if (first != source.end() && *first == '#') {
        p = std::find_if(p, source.end(), [](char c) { return text::is_line_end(c); });
        p += p != source.end();
        continue;
      }
      p = parse_row(p, values);
      if (p == nullptr) return false;
      const std::size_t count = values.size();
      if (count == 0) continue;  // an empty line
      if (rows.starts.empty()) {
        start_rows(count, rows);
        reader = text::number_line_reader(count);
      }
      if (count != rows.num_columns || count < 2) {
        error(code::kOtherColumns,
              rows.starts.empty()
                  ? std::string("expected a time and numbers, found a single number")
                  : fmt::format("expected {} numbers, as in the first row, found {}",
                                rows.num_columns, count),
              start);
        return false;
      }
      rows.append(values, start, source.end());
    }
    if (rows.starts.empty()) {
      error(code::kNoRows, "expected rows of a time and numbers, found none", source.end());
    }
    return !rows.starts.empty();
  }
};

}  // namespace

std::optional<Table> parse_table(const text::Source& source, std::optional<double> fps,
                                 Diagnostics& diagnostics) {
  Table table;
  if (!TableParser{source, diagnostics}.parse_rows(table.rows)) return std::nullopt;
  constexpr TableTimeCodes kCodes{code::kNotRising, code::kNoRate, code::kLateStart, code::kGap,
                                  code::kSlow};
  auto timeline = timeline_of_rows(source, table.rows, fps, kCodes, diagnostics);
  if (!timeline) return std::nullopt;
  table.timeline = std::move(*timeline);
  return table;
}

}  // namespace kinefile::hrpsys
