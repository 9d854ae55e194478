// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/numbers.hpp"

namespace kinefile::words {

/// The parts of a text between separators; none of an empty text.
inline std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t at = text.find(separator);
    parts.emplace_back(text.substr(0, at));
    if (at == std::string_view::npos) break;
    text.remove_prefix(at + 1);
  }
  return parts;
}

/// Reads a whole text as an integer; nothing if it is none.
template <class Integer>
std::optional<Integer> integer(std::string_view text) {
  Integer number{};
  const char* end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && next == end ? std::optional(number) : std::nullopt;
}

/// Reads a whole text as a finite number; nothing if it is none.
inline std::optional<double> finite(std::string_view text) {
  const text::Number number = text::parse_number(text);
  const bool is_good = number.fault == text::NumberFault::None && std::isfinite(number.value);
  return is_good ? std::optional(number.value) : std::nullopt;
}

}  // namespace kinefile::words
