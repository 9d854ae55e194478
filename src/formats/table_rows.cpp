// SPDX-License-Identifier: MIT
#include "formats/table_rows.hpp"

#include <fmt/format.h>

#include <cmath>

#include "formats/table_rate.hpp"

namespace kinefile {
namespace {

/// The part of a period within which a first time is read as 0.
constexpr double kStart = 1e-4;

/// The times of a table, which increase; empty after an error.
std::optional<std::vector<double>> times_of(const text::Source& source, const TableRows& rows,
                                            const char* code, Diagnostics& diagnostics) {
  std::vector<double> times;
  times.reserve(rows.starts.size());
  for (std::size_t i = 0; i < rows.starts.size(); ++i) {
    const double time = rows.values[i * rows.num_columns];
    if (!std::isfinite(time) || (i > 0 && time <= times.back())) {
      text::report(source, diagnostics, Severity::Error, code,
                   fmt::format("expected times that go up, found {}", time), rows.starts[i]);
      return std::nullopt;
    }
    times.push_back(time);
  }
  return times;
}

/// Half of the last digit of each row's time.
std::vector<double> half_digits_of(const text::Source& source, const TableRows& rows) {
  std::vector<double> halves;
  halves.reserve(rows.starts.size());
  for (const char* const start : rows.starts) {
    halves.push_back(half_of_last_digit(start, source.end()));
  }
  return halves;
}

}  // namespace

std::optional<Timeline> timeline_of_rows(const text::Source& source, const TableRows& rows,
                                         std::optional<double> fps, const TableTimeCodes& codes,
                                         Diagnostics& diagnostics) {
  auto times = times_of(source, rows, codes.not_rising, diagnostics);
  if (!times) return std::nullopt;
  if (fps) return Timeline{FrameRate{*fps}, 0};
  if (times->size() < 2) {
    text::report(source, diagnostics, Severity::Note, codes.no_rate,
                 "the table does not tell its rate; 30 frames a second are assumed (--fps says "
                 "otherwise)",
                 source.text().data());
    return Timeline{FrameRate{30}, 0};
  }
  const auto rate = rate_of_times(*times, half_digits_of(source, rows));
  if (!rate) return Timeline{FrameTimes{std::move(*times)}, 0};
  if (std::abs(times->front()) * *rate > kStart) {
    text::report(
        source, diagnostics, Severity::Note, codes.late_start,
        fmt::format("the table begins at {} s; times count from its first row on", times->front()),
        rows.starts.front());
  }
  return Timeline{FrameRate{*rate}, 0};
}

}  // namespace kinefile
