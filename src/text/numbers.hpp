// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace kinefile::text {

/// Whether a character separates words within a line: space, tab, vertical tab, form feed.
constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

/// Whether a character ends a line.
constexpr bool is_line_end(char c) { return c == '\n' || c == '\r'; }

/// Why a token is no number, or what is special about one that is.
enum class NumberFault {
  None,
  NotANumber,    ///< some character does not belong to a number
  OutOfRange,    ///< larger than any double, "1e400"
  DecimalComma,  ///< a number but for a comma in place of the point; its value is given
};

struct Number {
  double value = 0;
  NumberFault fault = NumberFault::None;
};

/// Reads a token as a double, correctly rounded. The whole token is the number: decimal digits
/// with an optional sign, point and exponent; or inf, infinity, nan in any case, with or without
/// a sign, and in the spellings of Microsoft's C library (1.#INF, -1.#IND, nan(ind)).
Number parse_number(std::string_view token);

/// Reads a token as a count: decimal digits alone. Empty if it is none or above 2^63 - 1.
std::optional<std::size_t> parse_count(std::string_view token);

/// How reading a row of numbers ended.
enum class RowEnd {
  EndOfLine,  ///< the line ended; `next` is behind its end
  Full,       ///< `capacity` numbers were read and the line goes on; `next` is the next token
  BadToken,   ///< `next` is a token that is no finite number in plain notation
};

struct NumberRow {
  std::size_t count = 0;  ///< numbers read
  RowEnd end = RowEnd::EndOfLine;
  const char* next = nullptr;
};

/// Reads the numbers of one line, separated by blanks, exact to the last bit. The one way in
/// which rows of numbers are read.
/// \param begin     where to start
/// \param end       the end of the text; it ends a line, too
/// \param out       room for `capacity` numbers
/// Reads no further than the line, or than `capacity` numbers. Does not allocate.
NumberRow read_number_row(const char* begin, const char* end, double* out, std::size_t capacity);

struct NumberList {
  std::size_t count = 0;
  bool ends_with_comma = true;  ///< or holds nothing
  bool has_break = false;       ///< whether it goes over several lines
  const char* next = nullptr;   ///< what is no part of the list
};

/// Reads numbers that are separated by commas, over any number of lines, exact to the last bit, and
/// appends them: as many as are finite numbers in plain notation, each followed by a comma, a
/// closing bracket or space.
NumberList read_number_list(const char* begin, const char* end, std::vector<double>& out);

}  // namespace kinefile::text
