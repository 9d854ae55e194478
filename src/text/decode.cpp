// SPDX-License-Identifier: MIT
#include "text/decode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "text/cp932.hpp"
#include "text/source.hpp"

namespace kinefile::text {

void append_utf8(std::string& out, char32_t c) {
  const auto byte = [](char32_t value) { return static_cast<char>(value); };
  if (c < 0x80) {
    out += byte(c);
  } else if (c < 0x800) {
    out += {byte(0xC0 | (c >> 6)), byte(0x80 | (c & 0x3F))};
  } else if (c < 0x10000) {
    out += {byte(0xE0 | (c >> 12)), byte(0x80 | ((c >> 6) & 0x3F)), byte(0x80 | (c & 0x3F))};
  } else {
    out += {byte(0xF0 | (c >> 18)), byte(0x80 | ((c >> 12) & 0x3F)), byte(0x80 | ((c >> 6) & 0x3F)),
            byte(0x80 | (c & 0x3F))};
  }
}

namespace {

constexpr char32_t kReplacement = 0xFFFD;

/// The length of the valid UTF-8 character at `i`, or 0 (Unicode 15, table 3-7).
std::size_t utf8_length(std::string_view bytes, std::size_t i) {
  const std::uint8_t a = byte_at(bytes, i);
  const std::uint8_t b = byte_at(bytes, i + 1);
  const auto is_tail = [&](std::size_t k) { return (byte_at(bytes, i + k) & 0xC0) == 0x80; };
  if (a < 0x80) return 1;
  if (a >= 0xC2 && a <= 0xDF) return is_tail(1) ? 2 : 0;
  if (a >= 0xE0 && a <= 0xEF) {
    const bool overlong = a == 0xE0 && b < 0xA0;
    const bool surrogate = a == 0xED && b > 0x9F;
    return is_tail(1) && is_tail(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (a >= 0xF0 && a <= 0xF4) {
    const bool out_of_range = (a == 0xF0 && b < 0x90) || (a == 0xF4 && b > 0x8F);
    return is_tail(1) && is_tail(2) && is_tail(3) && !out_of_range ? 4 : 0;
  }
  return 0;
}

/// Whether the bytes of a block are ASCII. The loop has no branch, so that it becomes vectors.
bool is_ascii_block(const char* block, std::size_t size) {
  unsigned char bits = 0;
  for (std::size_t i = 0; i < size; ++i) bits |= static_cast<unsigned char>(block[i]);
  return bits < 0x80;
}

/// The length of the valid UTF-8 prefix. Many ASCII bytes are checked at a time, because nearly
/// all of a motion file is digits.
std::size_t valid_utf8_prefix(std::string_view bytes) {
  constexpr std::size_t kBlock = 256;
  std::size_t i = 0;
  while (i < bytes.size()) {
    const bool is_block = i % kBlock == 0 && i + kBlock <= bytes.size();
    if (is_block && is_ascii_block(bytes.data() + i, kBlock)) {
      i += kBlock;
      continue;
    }
    const std::size_t length = utf8_length(bytes, i);
    if (length == 0) return i;
    i += length;
  }
  return bytes.size();
}

/// Offsets in the decoded text of bytes that could not be decoded.
using BadPlaces = std::vector<std::size_t>;

void append_bad(std::string& out, BadPlaces& bad) {
  bad.push_back(out.size());
  append_utf8(out, kReplacement);
}

std::string from_utf8(std::string_view bytes, BadPlaces& bad) {
  std::string out;
  for (std::size_t i = 0; i < bytes.size();) {
    const std::size_t length = utf8_length(bytes, i);
    if (length == 0) append_bad(out, bad);
    out.append(bytes.substr(i, length));
    i += std::max<std::size_t>(length, 1);
  }
  return out;
}

std::string from_utf16(std::string_view bytes, bool big_endian, BadPlaces& bad) {
  const auto unit_at = [&](std::size_t i) -> char32_t {
    const char32_t first = byte_at(bytes, i);
    const char32_t second = byte_at(bytes, i + 1);
    return big_endian ? (first << 8) | second : (second << 8) | first;
  };
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    const char32_t unit = unit_at(i);
    const bool is_high = unit >= 0xD800 && unit <= 0xDBFF && i + 3 < bytes.size();
    const char32_t next = is_high ? unit_at(i + 2) : 0;
    if (is_high && next >= 0xDC00 && next <= 0xDFFF) {
      append_utf8(out, 0x10000 + ((unit - 0xD800) << 10) + (next - 0xDC00));
      i += 2;
    } else if (i + 1 == bytes.size() || (unit >= 0xD800 && unit <= 0xDFFF)) {
      append_bad(out, bad);
    } else {
      append_utf8(out, unit);
    }
  }
  return out;
}

std::string from_latin1(std::string_view bytes) {
  std::string out;
  for (const char c : bytes) append_utf8(out, static_cast<std::uint8_t>(c));
  return out;
}

std::string from_cp932(std::string_view bytes, BadPlaces& bad) {
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::uint8_t byte = byte_at(bytes, i);
    if (byte < 0x80) {
      out += bytes[i];
    } else if (byte >= 0xA1 && byte <= 0xDF) {
      append_utf8(out, 0xFF61u + byte - 0xA1u);  // half-width katakana
    } else if (const auto c = cp932_character(byte, byte_at(bytes, i + 1))) {
      append_utf8(out, *c);
      ++i;
    } else {
      append_bad(out, bad);
    }
  }
  return out;
}

struct Detected {
  std::string encoding;
  std::size_t bom_length = 0;
};

Detected detect_encoding(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) return {"utf-8", 3};
  if (bytes.starts_with("\xFF\xFE")) return {"utf-16le", 2};
  if (bytes.starts_with("\xFE\xFF")) return {"utf-16be", 2};
  // Every motion format starts with an ASCII character, so one zero byte in the first pair means
  // UTF-16 without a mark.
  if (bytes.size() >= 4 && bytes[0] != 0 && bytes[1] == 0 && bytes[3] == 0) return {"utf-16le"};
  if (bytes.size() >= 4 && bytes[0] == 0 && bytes[1] != 0 && bytes[2] == 0) return {"utf-16be"};
  return {""};
}

}  // namespace

Result<DecodedText> decode(std::string_view bytes, const std::string& encoding,
                           const std::string& source_name, Diagnostics& diagnostics,
                           std::string_view fallback) {
  const Detected detected = detect_encoding(bytes);
  DecodedText text;
  text.encoding = encoding.empty() ? detected.encoding : encoding;
  text.has_bom = detected.bom_length > 0 && detected.encoding == text.encoding;
  if (text.has_bom) bytes.remove_prefix(detected.bom_length);

  const bool is_guess = text.encoding.empty();
  const std::size_t valid = is_guess || text.encoding == "utf-8" ? valid_utf8_prefix(bytes) : 0;
  if (is_guess) text.encoding = valid == bytes.size() ? "utf-8" : fallback;

  BadPlaces bad;
  if (text.encoding == "utf-8") {
    text.passed_through = bytes;
    if (valid < bytes.size()) text.storage = from_utf8(bytes, bad);
  } else if (text.encoding == "utf-16le" || text.encoding == "utf-16be") {
    text.storage = from_utf16(bytes, text.encoding == "utf-16be", bad);
  } else if (text.encoding == "latin-1") {
    text.storage = from_latin1(bytes);
  } else if (text.encoding == "cp932") {
    text.storage = from_cp932(bytes, bad);
  } else {
    return fail(make_error(ErrorKind::Usage, "TXT003",
                           fmt::format("expected the encoding utf-8, utf-16le, utf-16be, latin-1 "
                                       "or cp932, found {}",
                                       quoted(text.encoding))));
  }

  const Source source(source_name, text.view());
  const std::string message =
      fmt::format("expected a character of {}, found other bytes; read as U+FFFD", text.encoding);
  for (const std::size_t offset : bad) {
    report(source, diagnostics, Severity::Warning, "TXT001", message,
           source.text().data() + offset);
  }
  if (is_guess && text.encoding == "latin-1") {
    diagnostics.add(source.diagnose(
        Severity::Note, "TXT002",
        "the bytes are not UTF-8 and are read as Latin-1; --encoding names another encoding",
        source.text().data() + valid));
  }
  return text;
}

}  // namespace kinefile::text
