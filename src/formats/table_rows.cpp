// SPDX-License-Identifier: MIT
#include "formats/table_rows.hpp"

#include <fmt/format.h>

#include <cmath>

namespace kinefile {
namespace {

/// The times of a table, which go up; empty after an error.
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

/// Whether times are as far apart as a rate has it, to what a few digits leave of them.
bool are_steady(const std::vector<double>& times, double period) {
  constexpr double kLoose = 1e-3;  // of a period
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double expected = times.front() + static_cast<double>(i) * period;
    if (std::abs(times[i] - expected) > kLoose * period) return false;
  }
  return true;
}

}  // namespace

std::optional<Timeline> timeline_of_rows(const text::Source& source, const TableRows& rows,
                                         std::optional<double> fps, const TableTimeCodes& codes,
                                         Diagnostics& diagnostics) {
  constexpr double kWhole = 1e-4;
  constexpr double kLeastRate = 1e-9, kGreatestRate = 1e9;
  auto times = times_of(source, rows, codes.not_rising, diagnostics);
  if (!times) return std::nullopt;
  Timeline timeline;
  timeline.given = Timeline::Given::FrameRate;
  timeline.value = fps.value_or(30);
  if (fps) return timeline;
  if (times->size() < 2) {
    text::report(source, diagnostics, Severity::Note, codes.no_rate,
                 "the table does not tell its rate; 30 frames a second are assumed (--fps says "
                 "otherwise)",
                 source.text().data());
    return timeline;
  }
  const double period = (times->back() - times->front()) / static_cast<double>(times->size() - 1);
  const double rate = 1 / period;
  const bool is_rate = rate >= kLeastRate && rate <= kGreatestRate;
  if (!is_rate || !are_steady(*times, period)) {
    timeline.value = 0;
    timeline.times = std::move(*times);
    return timeline;
  }
  if (std::abs(times->front()) > kWhole * period) {
    text::report(
        source, diagnostics, Severity::Note, codes.late_start,
        fmt::format("the table begins at {} s; times count from its first row on", times->front()),
        rows.starts.front());
  }
  const double whole = std::round(rate);
  timeline.value = whole >= 1 && std::abs(rate - whole) <= kWhole * whole ? whole : rate;
  return timeline;
}

}  // namespace kinefile
