// SPDX-License-Identifier: MIT
#include "text/encode.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>

#include "text/cp932.hpp"
#include "text/decode.hpp"

namespace kinefile::text {
namespace {

constexpr std::array<std::string_view, 5> kEncodings = {"utf-8", "utf-16le", "utf-16be", "latin-1",
                                                        "cp932"};

std::size_t length_at(std::string_view text, std::size_t i) {
  const std::uint8_t lead = byte_at(text, i);
  const std::size_t length = lead < 0xC0 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  return std::min(length, text.size() - i);
}

char32_t character_of(std::string_view bytes) {
  constexpr std::array<std::uint8_t, 5> kLeadBits = {0, 0x7F, 0x1F, 0x0F, 0x07};
  char32_t c = byte_at(bytes, 0) & kLeadBits[bytes.size()];
  for (std::size_t i = 1; i < bytes.size(); ++i) c = (c << 6) | (byte_at(bytes, i) & 0x3F);
  return c;
}

void append_unit(std::string& out, char32_t unit, bool is_big_endian) {
  const char high = static_cast<char>(unit >> 8);
  const char low = static_cast<char>(unit & 0xFF);
  out += is_big_endian ? high : low;
  out += is_big_endian ? low : high;
}

void append_utf16(std::string& out, char32_t c, bool is_big_endian) {
  if (c < 0x10000) return append_unit(out, c, is_big_endian);
  append_unit(out, 0xD800 + ((c - 0x10000) >> 10), is_big_endian);
  append_unit(out, 0xDC00 + ((c - 0x10000) & 0x3FF), is_big_endian);
}

bool append_cp932(std::string& out, char32_t c) {
  const auto code = cp932_code(c);
  if (!code) return false;
  if (*code > 0xFF) out += static_cast<char>(*code >> 8);
  out += static_cast<char>(*code & 0xFF);
  return true;
}

bool append_latin1(std::string& out, char32_t c) {
  if (c > 0xFF) return false;
  out += static_cast<char>(c);
  return true;
}

}  // namespace

bool is_encoding(std::string_view encoding) {
  return std::find(kEncodings.begin(), kEncodings.end(), encoding) != kEncodings.end();
}

std::string_view byte_order_mark(std::string_view encoding) {
  if (encoding == "utf-8") return "\xEF\xBB\xBF";
  if (encoding == "utf-16le") return "\xFF\xFE";
  return encoding == "utf-16be" ? "\xFE\xFF" : "";
}

std::string_view append_encoded(std::string& out, std::string_view text,
                                std::string_view encoding) {
  assert(is_encoding(encoding));
  if (encoding == "utf-8") {
    out += text;
    return {};
  }
  const bool is_utf16 = encoding.starts_with("utf-16");
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view bytes = text.substr(i, length_at(text, i));
    const char32_t c = character_of(bytes);
    if (is_utf16) {
      append_utf16(out, c, encoding == "utf-16be");
    } else if (encoding == "cp932" ? !append_cp932(out, c) : !append_latin1(out, c)) {
      return bytes;
    }
    i += bytes.size();
  }
  return {};
}

}  // namespace kinefile::text
