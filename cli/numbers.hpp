// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace kinefile::cli {

/// Reads a whole text as a number; empty if it is not one.
template <class Number>
std::optional<Number> parse_number(std::string_view text) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && next == end ? std::optional(number) : std::nullopt;
}

/// Reads a whole text as a finite number.
inline std::optional<double> parse_finite(std::string_view text) {
  const auto number = parse_number<double>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

/// Why the text of an option is not a number within bounds; empty if it is.
inline std::string check_number(const std::string& text, double least, double most) {
  const auto number = parse_finite(text);
  const bool is_good = number && *number >= least && *number <= most;
  return is_good ? ""
                 : fmt::format("expected a number from {} to {}, found '{}'", least, most, text);
}

/// The same for a whole number.
inline std::string check_count(const std::string& text, std::uint64_t least, std::uint64_t most) {
  const auto number = parse_number<std::uint64_t>(text);
  const bool is_good = number && *number >= least && *number <= most;
  return is_good
             ? ""
             : fmt::format("expected a whole number from {} to {}, found '{}'", least, most, text);
}

}  // namespace kinefile::cli
