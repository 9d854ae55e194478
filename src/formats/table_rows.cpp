// SPDX-License-Identifier: MIT
#include "formats/table_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

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

/// Where times jump by two usual steps or more.
struct Gaps {
  double step = 0;        ///< the usual one; 0 if most steps are not of one size
  std::size_t count = 0;  ///< of gaps
  std::size_t row = 0;    ///< the first row after one
};

Gaps gaps_of(std::span<const double> times) {
  constexpr double kLoose = 0.1;  // of a step
  constexpr double kGap = 1.9;    // steps
  Gaps gaps;
  const double usual = median_step(times);
  std::size_t num_usual = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double step = times[i] - times[i - 1];
    num_usual += std::abs(step - usual) <= kLoose * usual ? 1 : 0;
    if (!(step >= kGap * usual)) continue;
    if (gaps.count++ == 0) gaps.row = i;
  }
  if (2 * num_usual >= times.size() - 1) gaps.step = usual;
  return gaps;
}

/// Notes rows that are missing among others at equal distances.
void note_gaps(const text::Source& source, const TableRows& rows, std::span<const double> times,
               const char* code, Diagnostics& diagnostics) {
  const Gaps gaps = gaps_of(times);
  if (gaps.step == 0 || gaps.count == 0) return;
  std::string message =
      fmt::format("{:.6g} s pass to this row, where {:.6g} s are usual; the rows keep their times",
                  times[gaps.row] - times[gaps.row - 1], gaps.step);
  if (gaps.count > 1) message += fmt::format(" (the first of {} gaps)", gaps.count);
  text::report(source, diagnostics, Severity::Note, code, std::move(message),
               rows.starts[gaps.row]);
}

/// Notes times that are hardly seconds: milliseconds or frame numbers.
void note_slow(const text::Source& source, const TableRows& rows, std::span<const double> times,
               const char* code, Diagnostics& diagnostics) {
  constexpr double kSlow = 1;  // s
  const double step = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  if (step < kSlow) return;
  text::report(source, diagnostics, Severity::Note, code,
               fmt::format("expected seconds, found times {:.6g} s apart in the mean, which makes "
                           "{:.6g} rows a second; --fps says another rate",
                           step, 1 / step),
               rows.starts[1]);
}

/// Reserves memory as if all rows were as long as the first one.
void reserve_rows(const char* begin, const char* end, TableRows& rows) {
  // A number has two bytes at the least, with its separator.
  const std::size_t least = 2 * rows.num_columns;
  const auto row_bytes =
      std::max(static_cast<std::size_t>(begin - rows.starts.front()) / rows.starts.size(), least);
  const std::size_t num_more = static_cast<std::size_t>(end - begin) / row_bytes;
  const std::size_t num_rows = rows.starts.size() + num_more + num_more / 16 + 1;
  rows.values.reserve(num_rows * rows.num_columns);
  rows.starts.reserve(num_rows);
}

}  // namespace

const char* append_like_rows(const char* begin, const char* end, const simd::RowTemplate& row,
                             TableRows& rows) {
  constexpr std::size_t kSomeNumbers = std::size_t{1} << 14;
  reserve_rows(begin, end, rows);
  const std::size_t most = kSomeNumbers / rows.num_columns + 1;
  while (true) {
    const std::size_t num_before = rows.starts.size();
    rows.starts.resize(num_before + most);
    double* const out = rows.values.grow(most * rows.num_columns).data();
    const simd::NumberRows read =
        simd::read_template_rows(begin, end, row, most, out, &rows.starts[num_before]);
    rows.starts.resize(num_before + read.num_rows);
    rows.values.resize(rows.starts.size() * rows.num_columns);
    begin = read.next;
    if (read.num_rows < most) return begin;
  }
}

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
  note_slow(source, rows, *times, codes.slow, diagnostics);
  const auto rate = rate_of_times(*times, half_digits_of(source, rows));
  if (!rate) {
    note_gaps(source, rows, *times, codes.gap, diagnostics);
    return Timeline{FrameTimes{std::move(*times)}, 0};
  }
  if (std::abs(times->front()) * *rate > kStart) {
    text::report(
        source, diagnostics, Severity::Note, codes.late_start,
        fmt::format("the table begins at {} s; times count from its first row on", times->front()),
        rows.starts.front());
  }
  return Timeline{FrameRate{*rate}, 0};
}

}  // namespace kinefile
