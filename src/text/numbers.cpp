// SPDX-License-Identifier: MIT
#include "text/numbers.hpp"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string>

#include "base/words.hpp"
#include "text/scanner.hpp"

namespace kinefile::text {
namespace {

/// The characters that end a number in a row, and in a list.
struct Space {
  static constexpr bool has(char c) { return is_blank(c) || is_line_end(c); }
};
/// The space characters of YAML, which does not allow form feeds.
struct ListSpace {
  static constexpr bool has(char c) { return c == ' ' || c == '\t' || is_line_end(c); }
};
struct ListSpaceOrSeparator {
  static constexpr bool has(char c) { return c == ',' || c == ']' || ListSpace::has(c); }
};

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The powers of ten that a double holds exactly.
constexpr double kPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// The number of digits that a 64-bit integer always holds, and that a double holds exactly.
constexpr std::ptrdiff_t kMostDigits = 19;
constexpr std::ptrdiff_t kExactDigits = 15;

/// The fast path is used if this many bytes can be read without checking for the end. A sign, 20
/// digits, a point, 20 more digits and the next character are 43.
constexpr std::ptrdiff_t kFastBytes = 43;

/// Reads eight digits at once, for numbers with many digits: each step joins neighbours, so that
/// three multiplications do the work of eight (Lemire, "Quickly parsing eight digits", 2018). Does
/// nothing if not all eight are digits, or on machines with another byte order.
inline bool take_eight_digits(const char* p, std::uint64_t& number) {
  if constexpr (std::endian::native != std::endian::little) return false;
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, p, 8);
  constexpr std::uint64_t kZeros = 0x3030303030303030;
  const std::uint64_t over = bytes + 0x4646464646464646;  // sets the high bit above '9'
  const std::uint64_t under = bytes - kZeros;             // and this one below '0'
  if (((over | under) & 0x8080808080808080) != 0) return false;
  std::uint64_t pairs = under * 10 + (under >> 8);
  pairs = ((pairs & 0x000000FF000000FF) * 0x000F424000000064 +
           ((pairs >> 16) & 0x000000FF000000FF) * 0x0000271000000001) >>
          32;
  number = number * 100000000 + pairs;
  return true;
}

/// Reads the form of nearly all numbers in motion files: a sign, digits, a point, digits, at most
/// 19 digits in total. With up to 15 digits such a number is a quotient of two whole numbers that
/// doubles hold exactly, so one division rounds it correctly (Clinger, "How to Read Floating Point
/// Numbers Accurately", 1990); with more, fast_float's arithmetic does (Lemire, "Number parsing at
/// a gigabyte per second", 2021). Null for any other token.
/// \param is_long  in: whether many digits are expected; out: whether there were many
/// Precondition: kFastBytes bytes can be read.
template <class TokenEnd>
inline const char* parse_decimal(const char* p, double& value, bool& is_long) {
  const bool is_negative = *p == '-';
  p += is_negative;
  std::uint64_t number = 0;
  const auto take_digits = [&] {
    const char* const first = p;
    while (is_long && p - first <= kMostDigits - 8 && take_eight_digits(p, number)) p += 8;
    for (; p - first <= kMostDigits && is_digit(*p); ++p) {
      number = number * 10 + static_cast<std::uint64_t>(*p - '0');
    }
    return p - first;
  };
  std::ptrdiff_t num_digits = take_digits();
  std::ptrdiff_t num_decimals = 0;
  if (*p == '.') {
    ++p;
    num_decimals = num_digits <= kMostDigits ? take_digits() : 0;
    num_digits += num_decimals;
  }
  if (!TokenEnd::has(*p) || num_digits == 0 || num_digits > kMostDigits) return nullptr;
  if (num_digits <= kExactDigits) {
    // The sign is applied by a product and not by a branch, because signs are not predictable.
    constexpr double kSigns[] = {1, -1};
    value = static_cast<double>(number) / kPowersOfTen[num_decimals] * kSigns[is_negative];
    is_long = false;
    return p;
  }
  const fast_float::adjusted_mantissa bits =
      fast_float::compute_float<fast_float::binary_format<double>>(-num_decimals, number);
  if (bits.power2 < 0) return nullptr;  // too close to the middle between two doubles
  fast_float::to_float(is_negative, bits, value);
  is_long = true;
  return p;
}

/// Reads a finite number in plain notation that is the whole token; null if there is none. Words
/// such as "nan" are left to `parse_number`, because they need a diagnostic.
template <class TokenEnd>
inline const char* parse_plain(const char* begin, const char* end, double& value, bool& is_long) {
  if (end - begin >= kFastBytes) {
    if (const char* next = parse_decimal<TokenEnd>(begin, value, is_long)) return next;
  }
  if (*begin == '+' && end - begin > 1 && begin[1] != '-') ++begin;
  const auto [next, error] = fast_float::from_chars(begin, end, value);
  if (error != std::errc() || !std::isfinite(value)) return nullptr;
  return next == end || TokenEnd::has(*next) ? next : nullptr;
}

/// The spellings of values that are not finite, without their sign.
std::optional<double> parse_special(std::string_view token) {
  static constexpr std::array<std::string_view, 6> kNans = {"nan",     "1.#ind",   "1.#qnan",
                                                            "1.#snan", "nan(ind)", "nan(snan)"};
  static constexpr std::array<std::string_view, 3> kInfinities = {"inf", "infinity", "1.#inf"};
  if (token.size() > 12) return std::nullopt;
  std::string word = lowered(token);
  const bool negative = word.starts_with('-');
  if (negative || word.starts_with('+')) word.erase(0, 1);
  // Microsoft's printf pads these with zeros: "-1.#IND00".
  if (word.find('#') != std::string::npos) word.erase(word.find_last_not_of('0') + 1);
  const auto is_word = [&](std::string_view known) { return word == known; };
  if (std::any_of(kNans.begin(), kNans.end(), is_word)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (std::any_of(kInfinities.begin(), kInfinities.end(), is_word)) {
    const double infinity = std::numeric_limits<double>::infinity();
    return negative ? -infinity : infinity;
  }
  return std::nullopt;
}

}  // namespace

Number parse_number(std::string_view token) {
  if (token.empty()) return {0, NumberFault::NotANumber};
  if (const auto special = parse_special(token)) return {*special, NumberFault::None};
  const char* end = token.data() + token.size();
  const char* begin = token.data() + (token[0] == '+' && token.size() > 1 && token[1] != '-');
  double value = 0;
  const auto [next, error] = fast_float::from_chars(begin, end, value);
  if (error == std::errc() && next == end) {
    // The words were read above: a value that is not finite here is "nan(...)" or too large.
    if (std::isnan(value)) return {0, NumberFault::NotANumber};
    return {value, std::isinf(value) ? NumberFault::OutOfRange : NumberFault::None};
  }
  const std::size_t comma = token.find(',');
  if (comma != std::string_view::npos && token.find('.') == std::string_view::npos) {
    std::string pointed(token);
    pointed[comma] = '.';
    const Number number = parse_number(pointed);
    if (number.fault == NumberFault::None && std::isfinite(number.value)) {
      return {number.value, NumberFault::DecimalComma};
    }
  }
  return {0, NumberFault::NotANumber};
}

std::optional<std::size_t> parse_count(std::string_view token) {
  if (token.empty() || token.size() > 19) return std::nullopt;
  std::uint64_t count = 0;
  for (const char c : token) {
    if (!is_digit(c)) return std::nullopt;
    count = count * 10 + static_cast<std::uint64_t>(c - '0');
  }
  if (count > std::numeric_limits<std::int64_t>::max()) return std::nullopt;
  if (count > std::numeric_limits<std::size_t>::max()) return std::nullopt;
  return static_cast<std::size_t>(count);
}

NumberRow read_number_row(const char* begin, const char* end, double* out, std::size_t capacity) {
  const char* p = begin;
  std::size_t count = 0;
  bool is_long = false;
  while (true) {
    while (p != end && is_blank(*p)) ++p;
    if (p == end) return {count, RowEnd::EndOfLine, p};
    if (is_line_end(*p)) {
      const bool is_crlf = *p == '\r' && p + 1 != end && p[1] == '\n';
      return {count, RowEnd::EndOfLine, p + (is_crlf ? 2 : 1)};
    }
    if (count == capacity) return {count, RowEnd::Full, p};
    const char* next = parse_plain<Space>(p, end, out[count], is_long);
    if (next == nullptr) return {count, RowEnd::BadToken, p};
    ++count;
    p = next;
  }
}

NumberList read_number_list(const char* begin, const char* end, Array<double>& out) {
  NumberList list;
  const auto skip_space = [end, &list](const char* p) {
    for (; p != end && ListSpace::has(*p); ++p) list.has_break |= is_line_end(*p);
    return p;
  };
  // Numbers are gathered here and appended together, which is faster than one by one.
  std::array<double, 64> piece;
  std::size_t num_in_piece = 0;
  const auto append_piece = [&] {
    out.append(std::span(piece.data(), num_in_piece));
    num_in_piece = 0;
  };
  list.next = skip_space(begin);
  bool is_long = false;
  while (list.next != end && list.ends_with_comma) {
    const char* const behind =
        parse_plain<ListSpaceOrSeparator>(list.next, end, piece[num_in_piece], is_long);
    if (behind == nullptr) break;
    ++list.count;
    if (++num_in_piece == piece.size()) append_piece();
    list.next = skip_space(behind);
    list.ends_with_comma = list.next != end && *list.next == ',';
    if (list.ends_with_comma) list.next = skip_space(list.next + 1);
  }
  append_piece();
  return list;
}

}  // namespace kinefile::text
