// SPDX-License-Identifier: MIT
#include "base/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "kinefile/diagnostics.hpp"

namespace kinefile {
namespace {

struct CodePoint {
  char32_t value = 0;
  std::size_t length = 0;  ///< in bytes; 0: the text does not start with UTF-8
};

CodePoint first_code_point(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  if (lead < 0x80) return {lead, 1};
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC2 ? 2 : 0;
  if (length == 0 || lead > 0xF4 || text.size() < length) return {};
  char32_t value = lead & (0x7Fu >> length);
  for (std::size_t k = 1; k < length; ++k) {
    const auto byte = static_cast<unsigned char>(text[k]);
    if ((byte & 0xC0u) != 0x80) return {};
    value = (value << 6) | (byte & 0x3Fu);
  }
  const bool is_overlong = (length == 3 && value < 0x800) || (length == 4 && value < 0x10000);
  return is_overlong ? CodePoint{} : CodePoint{value, length};
}

bool is_unprintable(char32_t c) {
  const bool is_control = c < 0x20 || (c >= 0x7F && c < 0xA0);
  // Unicode Standard Annex 9: marks, embeddings, overrides and isolates; and line separators.
  const bool is_direction = c == 0x61C || c == 0x200E || c == 0x200F ||
                            (c >= 0x202A && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
  return is_control || is_direction || c == 0x2028 || c == 0x2029;
}

}  // namespace

Character first_character(std::string_view text) {
  const CodePoint first = first_code_point(text);
  if (first.length == 0) return {};
  return {first.value, first.length, !is_unprintable(first.value)};
}

std::string printable(std::string_view text) {
  std::string safe;
  while (!text.empty()) {
    const CodePoint first = first_code_point(text);
    const std::string_view bytes = text.substr(0, std::max<std::size_t>(first.length, 1));
    if (first.length == 0 || (first.length == 1 && is_unprintable(first.value))) {
      safe += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[0]));
    } else if (is_unprintable(first.value)) {
      safe += fmt::format("\\u{:04x}", static_cast<std::uint32_t>(first.value));
    } else {
      safe += bytes;
    }
    text.remove_prefix(bytes.size());
  }
  return safe;
}

}  // namespace kinefile
