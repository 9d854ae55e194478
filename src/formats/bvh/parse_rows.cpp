// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "formats/bvh/codes.hpp"
#include "formats/bvh/parser.hpp"
#include "text/number_lines.hpp"
#include "text/numbers.hpp"

namespace kinefile::bvh {
namespace {

using text::NumberFault;
using text::NumberRow;
using text::quoted;
using text::RowEnd;

/// The shortest number and its blank: "0 ".
constexpr std::size_t kBytesPerNumber = 2;

struct Rows {
  Parser& parser;
  Body body;
  std::size_t num_columns;
  std::span<double> row = {};    ///< the current row: the last of `values`
  std::size_t num_seen = 0;      ///< rows seen so far, including faulty ones
  std::size_t num_reserved = 0;  ///< rows that there is memory for
  bool is_stream_refuted =
      false;  ///< the count of numbers does not fit, so rows end with their lines
  const char* known_row = nullptr;  ///< the last place where a later row was found

  File& file() { return parser.file; }
  const char* end() const { return parser.source.end(); }
  /// Makes a new current row; it is reused unless the row is kept.
  void open_row() { row = file().values.grow(num_columns); }
  void keep_row() {
    ++file().num_frames;
    open_row();
  }
  /// Truncates the values to the rows that were kept.
  void close_rows() { file().values.resize(file().num_frames * num_columns); }
};

std::size_t most_rows(const Rows& rows, const char* begin) {
  return most_rows(rows.parser.file, static_cast<std::size_t>(rows.end() - begin));
}

/// Reports a count that is far too large for the file: this is not a truncated clip, but a wrong
/// number.
void check_claim(Rows& rows, const char* begin) {
  constexpr std::size_t kFarTooMany = 1000;
  constexpr std::size_t kManyNumbers = std::size_t{1} << 27;  // 1 GiB of doubles
  const std::size_t most = most_rows(rows, begin);
  if (!rows.body.claim || *rows.body.claim <= most) return;
  const std::size_t num_columns = rows.num_columns;
  if (*rows.body.claim / kFarTooMany < most && *rows.body.claim < kManyNumbers / num_columns)
    return;
  rows.parser.repair(code::kImpossibleCount,
                     fmt::format("expected {} frames of {} numbers, found {} bytes, which hold {} "
                                 "at the most",
                                 *rows.body.claim, rows.num_columns, rows.end() - begin, most),
                     "the rows that are there are read", rows.body.claim_at);
  rows.body.claim.reset();
}

/// Reserves memory for the rows, estimated from the length of the first line. The count in the file
/// is used only if the file could contain as many.
void reserve_rows(Rows& rows, const char* begin) {
  const auto num_bytes = static_cast<std::size_t>(rows.end() - begin);
  const char* line = std::find_if_not(begin, rows.end(), text::is_line_end);
  const char* line_end = std::find_if(line, rows.end(), text::is_line_end);
  const auto line_bytes = static_cast<std::size_t>(line_end - line) + 1;
  const std::size_t num_likely = num_bytes / line_bytes + num_bytes / line_bytes / 16 + 1;
  const std::size_t num_rows =
      rows.body.claim ? *rows.body.claim : std::min(num_likely, most_rows(rows, begin));
  // While the file is read, one extra row is open.
  rows.num_reserved = std::min(num_rows, most_rows(rows, begin)) + 1;
  rows.file().values.reserve(rows.num_reserved * rows.num_columns);
}

/// Reads a token that the row reader rejected: a word for a value that is not finite, or not a
/// number.
std::optional<double> parse_odd_token(Parser& parser, std::string_view token) {
  const text::Number number = text::parse_number(token);
  if (number.fault == NumberFault::None && !std::isfinite(number.value)) {
    parser.report(Severity::Warning, code::kNotFinite,
                  fmt::format("expected a finite number, found {}; it is kept", quoted(token)),
                  token.data());
    return number.value;
  }
  return parse_value(parser, token, code::kNotANumber, "a number");
}

/// A row that the fast path rejected.
struct OddRow {
  std::size_t num_tokens = 0;
  const char* first_extra = nullptr;  ///< the first token beyond the columns
  const char* line_end = nullptr;
  bool is_row = true;   ///< the first token is a number
  bool is_good = true;  ///< every token is one
};

/// Reads the line at the scanner token by token into `rows.row`.
OddRow read_odd_row(Rows& rows) {
  OddRow odd;
  text::Scanner& scanner = rows.parser.scanner;
  while (true) {
    const std::string_view token = scanner.take_in_line();
    if (token.empty()) break;
    const auto value = parse_odd_token(rows.parser, token);
    odd.is_good &= value.has_value();
    if (odd.num_tokens == 0) odd.is_row = value.has_value();
    if (odd.num_tokens < rows.num_columns) rows.row[odd.num_tokens] = value.value_or(0);
    if (odd.num_tokens == rows.num_columns) odd.first_extra = token.data();
    ++odd.num_tokens;
  }
  odd.line_end = scanner.position();
  return odd;
}

std::size_t count_tokens_in_line(const Rows& rows, const char* begin) {
  text::Scanner scanner({begin, static_cast<std::size_t>(rows.end() - begin)});
  std::size_t count = 0;
  while (!scanner.take_in_line().empty()) ++count;
  return count;
}

/// Whether the rest of the text has exactly as many numbers as the count of frames still needs,
/// with any line breaks. Computed once: the answer for a later line would be the same.
bool is_stream(Rows& rows, const char* begin) {
  if (std::exchange(rows.is_stream_refuted, true)) return false;
  if (!rows.body.claim || *rows.body.claim <= rows.parser.file.num_frames) return false;
  if (*rows.body.claim > most_rows(rows, rows.parser.source.text().data())) return false;
  const std::size_t num_missing =
      (*rows.body.claim - rows.parser.file.num_frames) * rows.num_columns;
  text::Scanner scanner({begin, static_cast<std::size_t>(rows.end() - begin)});
  std::size_t count = 0;
  for (std::string_view token = scanner.take(); !token.empty(); token = scanner.take()) {
    if (token.starts_with('#')) {
      scanner.take_line();
      continue;
    }
    const NumberFault fault = text::parse_number(token).fault;
    const bool is_repaired = fault == NumberFault::DecimalComma && rows.parser.options.lenient;
    if (fault != NumberFault::None && !is_repaired) return false;
    if (++count > num_missing) return false;
  }
  return count == num_missing;
}

/// Reads all numbers up to the end of the text and ignores line ends. Only after `is_stream`.
void read_stream(Rows& rows, const char* begin) {
  rows.parser.report(
      Severity::Warning, code::kReadAsStream,
      fmt::format("expected a row of {} numbers, found {}; since the rest holds just "
                  "the numbers of {} frames, line ends are passed over",
                  rows.num_columns, count_tokens_in_line(rows, begin),
                  *rows.body.claim - rows.file().num_frames),
      begin);
  rows.close_rows();
  std::span<double> missing =
      rows.file().values.grow((*rows.body.claim - rows.file().num_frames) * rows.num_columns);
  const auto take = [&missing](std::size_t count) { missing = missing.subspan(count); };
  const char* p = begin;
  while (p != rows.end()) {
    const NumberRow part = text::read_number_row(p, rows.end(), missing.data(), missing.size());
    take(part.count);
    p = part.next;
    if (part.end == RowEnd::EndOfLine) continue;
    rows.parser.scanner.move_to(p);
    if (skip_comment(rows.parser)) {
      p = rows.parser.scanner.position();
      continue;
    }
    const auto value = parse_odd_token(rows.parser, rows.parser.scanner.take_in_line());
    if (value && !missing.empty()) {
      missing.front() = *value;
      take(1);
    }
    p = rows.parser.scanner.position();
  }
  rows.file().num_frames = *rows.body.claim;
}

/// Whether some line from here on starts with a number. The result is remembered, so that all calls
/// together read the text once.
bool has_row(Rows& rows, const char* begin) {
  if (rows.known_row != nullptr && begin <= rows.known_row) return true;
  text::Scanner scanner({begin, static_cast<std::size_t>(rows.end() - begin)});
  while (true) {
    const std::string_view word = scanner.peek();
    if (word.empty()) return false;
    if (text::parse_number(word).fault != NumberFault::NotANumber) {
      rows.known_row = word.data();
      return true;
    }
    scanner.take_line();
  }
}

/// Whether the text from here on is not part of the motion: all frames were read, and no line of
/// it starts with a number.
bool is_trailing_text(Rows& rows, const char* begin) {
  return rows.body.claim && rows.num_seen >= *rows.body.claim && !has_row(rows, begin);
}

void report_row_length(Rows& rows, const OddRow& odd) {
  const std::string message = fmt::format("expected {} numbers in the row of frame {}, found {}",
                                          rows.num_columns, rows.num_seen, odd.num_tokens);
  if (odd.num_tokens > rows.num_columns) {
    if (rows.parser.repair(code::kRowLength, message, "the numbers beyond are dropped",
                           odd.first_extra)) {
      rows.keep_row();
    }
  } else if (!has_row(rows, odd.line_end)) {
    rows.parser.repair(code::kRowLength, message + ": the file ends within the frame",
                       "the frame is dropped", odd.line_end);
  } else {
    rows.parser.report(Severity::Error, code::kRowLength, message, odd.line_end);
  }
}

/// Handles a line that is not a plain row. Returns where to continue.
const char* read_odd_line(Rows& rows, const char* line) {
  text::Scanner& scanner = rows.parser.scanner;
  scanner.move_to(line);
  if (skip_comment(rows.parser)) return scanner.position();
  if (text::equals_ignoring_case(scanner.peek_in_line(), "HIERARCHY")) {
    rows.parser.report(Severity::Error, code::kUnexpectedWord,
                       "expected a row of numbers, found 'HIERARCHY', the start of another file",
                       scanner.position());
    return rows.end();
  }
  if (is_trailing_text(rows, line)) {
    rows.parser.report(Severity::Warning, code::kTextAfterFrames,
                       fmt::format("expected nothing after the last frame, found {}; the rest of "
                                   "the file is not read",
                                   quoted(scanner.peek_in_line())),
                       scanner.peek_in_line().data());
    return rows.end();
  }
  const bool is_row_length = count_tokens_in_line(rows, line) == rows.num_columns;
  if (!is_row_length && is_stream(rows, line)) {
    read_stream(rows, line);
    return rows.end();
  }
  const OddRow odd = read_odd_row(rows);
  const bool has_length = odd.num_tokens == rows.num_columns;
  if (odd.is_good && has_length) rows.keep_row();
  if (odd.is_row && !has_length) report_row_length(rows, odd);
  ++rows.num_seen;
  return scanner.position();
}

/// How many rows are looked for at once: as many as there is memory for; if there are more, some.
std::size_t rows_at_once(const Rows& rows, const char* p) {
  constexpr std::size_t kSomeNumbers = std::size_t{1} << 16;
  const std::size_t num_frames = rows.parser.file.num_frames;
  const std::size_t left = rows.num_reserved > num_frames
                               ? rows.num_reserved - num_frames
                               : std::max<std::size_t>(kSomeNumbers / rows.num_columns, 1);
  return std::min(left, most_rows(rows, p));
}

/// Reads rows and empty lines as far as they go. The row that was open is one of them.
/// \returns  the first line that is neither
const char* read_good_lines(Rows& rows, const char* begin) {
  const char* p = begin;
  rows.close_rows();
  for (bool is_more = true; is_more;) {
    const std::size_t most = rows_at_once(rows, p);
    double* const out = rows.file().values.grow(most * rows.num_columns).data();
    const simd::NumberRows read =
        text::read_number_lines(p, rows.end(), rows.num_columns, most, out);
    rows.file().num_frames += read.num_rows;
    rows.num_seen += read.num_rows;
    rows.close_rows();
    is_more = read.num_rows == most && read.next != rows.end();
    p = read.next;
  }
  rows.open_row();
  return p;
}

void read_rows(Rows& rows, const char* begin) {
  rows.open_row();
  for (const char* p = begin; p != rows.end();) {
    p = read_good_lines(rows, p);
    if (p != rows.end()) p = read_odd_line(rows, p);
  }
  rows.close_rows();
}

/// A motion without columns has one empty line per frame.
void read_empty_rows(Rows& rows, const char* begin) {
  text::Scanner scanner({begin, static_cast<std::size_t>(rows.end() - begin)});
  scanner.take_line();  // the rest of the line with the last count
  std::size_t num_ends = 0;
  for (const char* p = scanner.position(); p != rows.end();) {
    const NumberRow line = text::read_number_row(p, rows.end(), nullptr, 0);
    if (line.end != RowEnd::EndOfLine) break;
    num_ends += text::is_line_end(line.next[-1]) ? 1 : 0;
    p = line.next;
  }
  const std::size_t num_lines = num_ends > 0 ? num_ends - 1 : 0;
  const std::string_view word = scanner.peek();
  if (!word.empty()) {
    rows.parser.report(
        Severity::Error, code::kRowLength,
        fmt::format("expected no numbers, since no joint has channels, found {}", quoted(word)),
        word.data());
  }
  rows.file().num_frames = std::min(rows.body.claim.value_or(num_lines), num_lines);
}

/// Reports words that are not numbers; used when the length of rows is unknown.
void check_tokens(Parser& parser) {
  while (true) {
    if (skip_comment(parser)) continue;
    const std::string_view token = parser.scanner.take();
    if (token.empty()) return;
    parse_odd_token(parser, token);
  }
}

}  // namespace

void count_columns(File& file) {
  file.num_columns = 0;
  for (const Node& node : file.nodes) file.num_columns += node.channels.size();
}

std::size_t most_rows(const File& file, std::size_t num_bytes) {
  return num_bytes / (kBytesPerNumber * std::max<std::size_t>(file.num_columns, 1)) + 1;
}

void compare_with_claim(const text::Source& source, const Body& body, std::size_t num_frames,
                        Diagnostics& diagnostics) {
  if (!body.claim || diagnostics.has_errors() || *body.claim == num_frames) return;
  text::report(source, diagnostics, Severity::Warning,
               num_frames > *body.claim ? code::kMoreRows : code::kFewerRows,
               fmt::format("expected as many rows as Frames says, {}, found {}; those are read",
                           *body.claim, num_frames),
               body.claim_at);
}

void parse_rows(Parser& parser, const Body& body) {
  if (!parser.is_structure_sound) return check_tokens(parser);
  count_columns(parser.file);
  Rows rows{parser, body, parser.file.num_columns};
  if (rows.num_columns == 0) {
    read_empty_rows(rows, body.begin);
  } else {
    check_claim(rows, body.begin);
    reserve_rows(rows, body.begin);
    read_rows(rows, body.begin);
  }
  compare_with_claim(parser.source, rows.body, parser.file.num_frames, parser.diagnostics);
}

}  // namespace kinefile::bvh
