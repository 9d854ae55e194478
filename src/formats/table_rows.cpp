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

/// Reserves memory as if all rows were like the first ones.
/// \param row_bytes  of the text of one
/// \param num_bytes  of the text of those that follow
void reserve_rows(std::size_t row_bytes, std::size_t num_bytes, TableRows& rows) {
  // A number has two bytes at the least, with its separator.
  const std::size_t likely = num_bytes / std::max(row_bytes, 2 * rows.num_columns);
  const std::size_t num_more = likely + likely / 16 + 1;
  const std::size_t num_rows = rows.starts.size() + num_more;
  rows.times.reserve(num_rows);
  rows.half_digits.reserve(num_rows);
  rows.starts.reserve(num_rows);
  // Numbers without a column need no bytes in the file.
  for (TablePart& part : rows.parts) {
    part.values.reserve(part.values.size() + std::min(num_more * part.width, num_bytes));
  }
}

/// Takes the rows of a piece.
/// \param start  of their texts; null: where they are
void append_piece(const text::RowPiece& piece, const char* start, TableRows& rows) {
  const double* row = piece.values.data();
  for (const char* const at : piece.starts) {
    rows.append({row, rows.num_columns}, at, piece.end);
    if (start != nullptr) rows.starts.back() = start;
    row += rows.num_columns;
  }
}

}  // namespace

void TableRows::add_part(std::span<const std::size_t> columns) {
  parts.push_back({column_runs(columns), columns.size(), {}});
}

void TableRows::append(std::span<const double> row, const char* start, const char* end) {
  times.push_back(row[0]);
  half_digits.push_back(half_of_last_digit(start, end));
  starts.push_back(start);
  for (TablePart& part : parts) {
    take_columns(part.columns, row.data(), part.values.grow(part.width).data());
  }
}

const char* append_rows(const char* begin, const char* end, const text::RowReader& reader,
                        TableRows& rows) {
  const auto bytes_before = static_cast<std::size_t>(begin - rows.starts.front());
  reserve_rows(bytes_before / rows.starts.size(), static_cast<std::size_t>(end - begin), rows);
  return text::read_row_pieces(begin, end, reader, [&rows](const text::RowPiece& piece) {
    append_piece(piece, nullptr, rows);
    return true;
  });
}

bool append_rows(const ByteSource& bytes, std::size_t offset, const text::RowReader& reader,
                 const char* start, TableRows& rows) {
  const auto bytes_before = static_cast<std::size_t>(start - rows.starts.front());
  reserve_rows(bytes_before / rows.starts.size(), bytes.size - offset, rows);
  const auto use = [&](const text::RowPiece& piece) {
    append_piece(piece, start, rows);
    return true;
  };
  return text::read_row_pieces(bytes, offset, reader, use) == text::PiecesEnd::AllRead;
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
  const auto rate = rate_of_times(times, rows.half_digits);
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
