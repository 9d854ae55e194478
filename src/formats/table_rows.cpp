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

/// Whether the times of a table are finite and increase; reports a fault.
bool do_times_rise(const text::Source& source, const TableRows& rows, const char* code,
                   Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < rows.times.size(); ++i) {
    const double time = rows.times[i];
    if (std::isfinite(time) && (i == 0 || time > rows.times[i - 1])) continue;
    text::report(source, diagnostics, Severity::Error, code,
                 fmt::format("expected times that go up, found {}", time), rows.starts[i]);
    return false;
  }
  return true;
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

/// Reserves memory as if all rows were as long as those before them.
void reserve_rows(const char* begin, const char* end, TableRows& rows) {
  // A number has two bytes at the least, with its separator.
  const std::size_t least = 2 * rows.num_columns;
  const auto row_bytes =
      std::max(static_cast<std::size_t>(begin - rows.starts.front()) / rows.starts.size(), least);
  const std::size_t num_more = static_cast<std::size_t>(end - begin) / row_bytes;
  const std::size_t num_rows = rows.starts.size() + num_more + num_more / 16 + 1;
  rows.times.reserve(num_rows);
  rows.starts.reserve(num_rows);
  // Numbers without a column need no bytes in the file.
  const auto num_bytes = static_cast<std::size_t>(end - rows.starts.front());
  for (TablePart& part : rows.parts) {
    part.values.reserve(std::min(num_rows * part.width, num_bytes));
  }
}

/// Appends what a reader of many rows finds.
/// \param read  called with the place, the most rows, and room for their numbers and starts
template <class Read>
const char* append_many(const char* begin, const char* end, const Read& read, TableRows& rows) {
  constexpr std::size_t kSomeNumbers = std::size_t{1} << 14;
  reserve_rows(begin, end, rows);
  const std::size_t most = kSomeNumbers / rows.num_columns + 1;
  Array<double> numbers(most * rows.num_columns);
  std::vector<const char*> starts(most);
  while (true) {
    const simd::NumberRows found = read(begin, most, numbers.mutate().data(), starts.data());
    const double* row = numbers.data();
    for (std::size_t i = 0; i < found.num_rows; ++i, row += rows.num_columns) {
      rows.append({row, rows.num_columns}, starts[i]);
    }
    begin = found.next;
    if (found.num_rows < most) return begin;
  }
}

}  // namespace

void TableRows::add_part(std::span<const std::size_t> columns) {
  parts.push_back({column_runs(columns), columns.size(), {}});
}

void TableRows::append(std::span<const double> row, const char* start) {
  times.push_back(row[0]);
  starts.push_back(start);
  for (TablePart& part : parts) {
    take_columns(part.columns, row.data(), part.values.grow(part.width).data());
  }
}

const char* append_number_rows(const char* begin, const char* end, TableRows& rows) {
  const auto read = [&](const char* at, std::size_t most, double* out, const char** starts) {
    return simd::read_number_rows(at, end, rows.num_columns, most, out, starts);
  };
  return append_many(begin, end, read, rows);
}

const char* append_like_rows(const char* begin, const char* end, const simd::RowTemplate& row,
                             TableRows& rows) {
  const auto read = [&](const char* at, std::size_t most, double* out, const char** starts) {
    return simd::read_template_rows(at, end, row, most, out, starts);
  };
  return append_many(begin, end, read, rows);
}

std::optional<Timeline> timeline_of_rows(const text::Source& source, const TableRows& rows,
                                         std::optional<double> fps, const TableTimeCodes& codes,
                                         Diagnostics& diagnostics) {
  if (!do_times_rise(source, rows, codes.not_rising, diagnostics)) return std::nullopt;
  const std::vector<double>& times = rows.times;
  if (fps) return Timeline{FrameRate{*fps}, 0};
  if (times.size() < 2) {
    text::report(source, diagnostics, Severity::Note, codes.no_rate,
                 "the table does not tell its rate; 30 frames a second are assumed (--fps says "
                 "otherwise)",
                 source.text().data());
    return Timeline{FrameRate{30}, 0};
  }
  note_slow(source, rows, times, codes.slow, diagnostics);
  const auto rate = rate_of_times(times, half_digits_of(source, rows));
  if (!rate) {
    note_gaps(source, rows, times, codes.gap, diagnostics);
    return Timeline{FrameTimes{times}, 0};
  }
  if (std::abs(times.front()) * *rate > kStart) {
    text::report(
        source, diagnostics, Severity::Note, codes.late_start,
        fmt::format("the table begins at {} s; times count from its first row on", times.front()),
        rows.starts.front());
  }
  return Timeline{FrameRate{*rate}, 0};
}

}  // namespace kinefile
