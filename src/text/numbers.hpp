// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "kinefile/array.hpp"

namespace kinefile::text {

/// Whether a character separates words within a line: space, tab, vertical tab, form feed.
constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

/// Whether a character ends a line.
constexpr bool is_line_end(char c) { return c == '\n' || c == '\r'; }

/// Why a token is not a number, or what is special about the number.
enum class NumberFault {
  None,
  NotANumber,    ///< some character is not part of a number
  OutOfRange,    ///< larger than any double, "1e400"
  DecimalComma,  ///< a number with a comma in place of the point; its value is given
};

struct Number {
  double value = 0;
  NumberFault fault = NumberFault::None;
};

/// Reads a token as a double, correctly rounded. The whole token is the number: decimal digits
/// with an optional sign, point and exponent; or inf, infinity, nan in any case, with or without
/// a sign, and in the spellings of Microsoft's C library (1.#INF, -1.#IND, nan(ind)).
Number parse_number(std::string_view token);

/// Reads a token as a count: only decimal digits. Empty if it is not one, or above 2^63 - 1.
std::optional<std::size_t> parse_count(std::string_view token);

/// How reading a row of numbers ended.
enum class RowEnd {
  EndOfLine,  ///< the line ended; `next` is after its end
  Full,       ///< `capacity` numbers were read and the line continues; `next` is the next token
  BadToken,   ///< `next` is a token that is not a finite number in plain notation
};

struct NumberRow {
  std::size_t count = 0;  ///< numbers read
  RowEnd end = RowEnd::EndOfLine;
  const char* next = nullptr;
};

/// Reads the numbers of one line, separated by blanks, exact to the last bit. All rows of numbers
/// are read with this function. It reads no further than the line, or than `capacity` numbers, and
/// does not allocate.
/// \param begin  where to start
/// \param end    the end of the text, which also ends the line
/// \param out    room for `capacity` numbers
NumberRow read_number_row(const char* begin, const char* end, double* out, std::size_t capacity);

struct NumberList {
  std::size_t count = 0;
  bool ends_with_comma = true;  ///< or is empty
  bool has_break = false;       ///< whether it spans several lines
  const char* next = nullptr;   ///< the first character after the list
};

/// Reads numbers that are separated by commas, over any number of lines, exact to the last bit, and
/// appends them: stops at the first that is not a finite number in plain notation followed by a
/// comma, a closing bracket or space.
NumberList read_number_list(const char* begin, const char* end, Array<double>& out);

}  // namespace kinefile::text
