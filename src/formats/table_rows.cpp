// SPDX-License-Identifier: MIT
#include "formats/table_rows.hpp"

#include <fmt/format.h>

#include <cmath>

namespace kinefile {
namespace {

/// The relative tolerance within which a rate is read as a whole number, and a first time as 0.
constexpr double kWhole = 1e-4;

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

/// Whether times have equal distances of one period, within the rounding of a few digits.
bool are_steady(const std::vector<double>& times, double period) {
  constexpr double kLoose = 1e-3;  // of a period
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double expected = times.front() + static_cast<double>(i) * period;
    if (std::abs(times[i] - expected) > kLoose * period) return false;
  }
  return true;
}

/// Whether times are those of consecutive frames, to the last digit of each.
/// \param most  how far a time may be from its frame, in periods
bool are_rounded(const std::vector<double>& times, double rate, double most) {
  const auto first = frame_that_holds(times.front(), rate);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto frame = frame_that_holds(times[i], rate);
    if (!frame || *frame != *first + static_cast<double>(i)) return false;
    if (std::abs(times[i] * rate - *frame) > most) return false;
  }
  return true;
}

/// The rate of two or more times, if they have one.
std::optional<double> rate_of(const std::vector<double>& times) {
  constexpr double kLeastRate = 1e-9, kGreatestRate = 1e9;
  const double period = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  const double rate = 1 / period;
  if (!(rate >= kLeastRate && rate <= kGreatestRate)) return std::nullopt;
  const double whole = std::round(rate);
  if (are_steady(times, period)) {
    return whole >= 1 && std::abs(rate - whole) <= kWhole * whole ? whole : rate;
  }
  const auto usual = steady_rate(times);
  if (usual && usual->holds_times && are_rounded(times, usual->per_second, 0.5)) {
    return usual->per_second;
  }
  if (whole >= 1 && are_rounded(times, whole, 0.05)) return whole;
  return std::nullopt;
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
  const auto rate = rate_of(*times);
  if (!rate) return Timeline{FrameTimes{std::move(*times)}, 0};
  if (std::abs(times->front()) * *rate > kWhole) {
    text::report(
        source, diagnostics, Severity::Note, codes.late_start,
        fmt::format("the table begins at {} s; times count from its first row on", times->front()),
        rows.starts.front());
  }
  return Timeline{FrameRate{*rate}, 0};
}

}  // namespace kinefile
