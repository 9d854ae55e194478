// SPDX-License-Identifier: MIT
// Anchors, aliases, tags and directives (YAML 1.1, 6.8 and 7.1).

#include <cstring>

#include "text/yaml/scanner.hpp"

namespace kinefile::text::yaml {
namespace {

bool is_word_character(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         c == '-';
}

bool is_among(char c, const char* characters) {
  return c != '\0' && std::strchr(characters, c) != nullptr;
}

/// How many bytes a character of UTF-8 has, by its first; 0 for no such byte.
std::size_t utf8_width(unsigned char first) {
  if (first < 0x80) return 1;
  if ((first & 0xE0) == 0xC0) return 2;
  if ((first & 0xF0) == 0xE0) return 3;
  return (first & 0xF8) == 0xF0 ? 4 : 0;
}

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

}  // namespace

bool Scanner::scan_anchor() {
  const char* const at = cursor_.position();
  const TokenKind kind = cursor_.peek() == '*' ? TokenKind::Alias : TokenKind::Anchor;
  cursor_.skip();
  const char* const name = cursor_.position();
  while (is_word_character(cursor_.peek())) cursor_.skip();
  const auto length = static_cast<std::size_t>(cursor_.position() - name);
  if (length == 0 || !(cursor_.ends_word() || is_among(cursor_.peek(), "?:,]}%@`"))) {
    return fail(at, "expected a name of letters and digits behind '*' or '&'");
  }
  tokens_.push_back({kind, at, {name, length}, {}});
  last_ = kind;
  return true;
}

bool Scanner::scan_tag() {
  const char* const at = cursor_.position();
  std::string handle, suffix;
  if (cursor_.peek(1) == '<') {
    cursor_.skip(2);
    if (!scan_uri(true, suffix)) return false;
    if (suffix.empty()) return fail(at, "expected a tag between '!<' and '>'");
    if (cursor_.peek() != '>') return fail(cursor_.position(), "expected '>' behind a tag");
    cursor_.skip();
  } else {
    if (!scan_handle(false, handle)) return false;
    const bool is_handle = handle.size() > 1 && handle.back() == '!';
    if (!is_handle) {
      suffix = handle.substr(1);
      handle = "!";
    }
    if (!scan_uri(false, suffix)) return false;
    if (suffix.empty() && is_handle) return fail(at, "expected the rest of the tag");
    if (suffix.empty()) handle.swap(suffix);  // "!" alone: no tag, but not plain
  }
  const bool is_in_flow = candidates_.size() > 1;
  if (!cursor_.ends_word() && !(is_in_flow && cursor_.peek() == ',')) {
    return fail(cursor_.position(), "expected a blank or the end of the line behind a tag");
  }
  Token token{TokenKind::Tag, at, keep(std::move(handle)), {}};
  token.suffix = keep(std::move(suffix));
  tokens_.push_back(token);
  last_ = token.kind;
  return true;
}

/// Reads "!", "!!" or "!word!"; in a tag also "!word", which is a handle and the start of a suffix.
bool Scanner::scan_handle(bool is_directive, std::string& handle) {
  const char* const at = cursor_.position();
  if (cursor_.peek() != '!') return fail(at, "expected '!'");
  cursor_.skip();
  while (is_word_character(cursor_.peek())) cursor_.skip();
  if (cursor_.peek() == '!') {
    cursor_.skip();
  } else if (is_directive && cursor_.position() - at > 1) {
    return fail(cursor_.position(), "expected '!' at the end of a tag's handle");
  }
  handle.assign(at, cursor_.position());
  return true;
}

bool Scanner::scan_uri(bool is_verbatim, std::string& uri) {
  while (true) {
    const char c = cursor_.peek();
    if (c == '%') {
      if (!scan_escaped_character(uri)) return false;
    } else if (is_word_character(c) || is_among(c, ";/?:@&=+$.!~*'()") ||
               (is_verbatim && is_among(c, ",[]"))) {
      uri += c;
      cursor_.skip();
    } else {
      return true;
    }
  }
}

/// Reads the bytes of one character, each as % and two hexadecimal digits.
bool Scanner::scan_escaped_character(std::string& uri) {
  const char* const at = cursor_.position();
  std::size_t num_left = 1;
  for (bool is_first = true; num_left > 0; --num_left, is_first = false) {
    const int high = hex_value(cursor_.peek(1));
    const int low = hex_value(cursor_.peek(2));
    if (cursor_.peek() != '%' || high < 0 || low < 0) {
      return fail(at, "expected % and two hexadecimal digits for each byte of a character");
    }
    const auto byte = static_cast<unsigned char>(high * 16 + low);
    if (is_first) num_left = utf8_width(byte);
    const bool is_good = is_first ? num_left > 0 : (byte & 0xC0) == 0x80;
    if (!is_good) return fail(at, "expected the bytes of a character in UTF-8");
    uri += static_cast<char>(byte);
    cursor_.skip(3);
  }
  return true;
}

bool Scanner::scan_directive() {
  const char* const at = cursor_.position();
  cursor_.skip();
  const char* const name_start = cursor_.position();
  while (is_word_character(cursor_.peek())) cursor_.skip();
  const std::string_view name(name_start,
                              static_cast<std::size_t>(cursor_.position() - name_start));
  if (!cursor_.ends_word() || (name != "YAML" && name != "TAG")) {
    return fail(at, "expected the directive %YAML or %TAG");
  }
  while (cursor_.is_blank()) cursor_.skip();
  if (!(name == "YAML" ? scan_version(at) : scan_tag_directive(at))) return false;
  while (cursor_.is_blank()) cursor_.skip();
  if (cursor_.peek() == '#') skip_comment();
  if (!cursor_.is_at_end() && !cursor_.is_break()) {
    return fail(cursor_.position(), "expected a comment or the end of the line");
  }
  if (cursor_.is_break()) cursor_.skip_break();
  return true;
}

bool Scanner::scan_version(const char* at) {
  int major = 0;
  int minor = 0;
  const char* const start = cursor_.position();
  if (!scan_version_number(major)) return false;
  if (cursor_.peek() != '.') return fail(cursor_.position(), "expected '.' in YAML's version");
  cursor_.skip();
  if (!scan_version_number(minor)) return false;
  const std::string_view version(start, static_cast<std::size_t>(cursor_.position() - start));
  Token token{TokenKind::VersionDirective, at, version, {}};
  tokens_.push_back(token);
  last_ = token.kind;
  return true;
}

bool Scanner::scan_version_number(int& number) {
  constexpr int kMostDigits = 9;
  int num_digits = 0;
  for (; cursor_.peek() >= '0' && cursor_.peek() <= '9'; ++num_digits) {
    if (num_digits == kMostDigits) return fail(cursor_.position(), "expected a shorter number");
    number = number * 10 + (cursor_.peek() - '0');
    cursor_.skip();
  }
  return num_digits > 0 || fail(cursor_.position(), "expected a number in YAML's version");
}

bool Scanner::scan_tag_directive(const char* at) {
  std::string handle, prefix;
  if (!scan_handle(true, handle)) return false;
  if (!cursor_.is_blank()) return fail(cursor_.position(), "expected a blank behind the handle");
  while (cursor_.is_blank()) cursor_.skip();
  const char* const start = cursor_.position();
  if (!scan_uri(true, prefix)) return false;
  if (prefix.empty()) return fail(start, "expected the prefix that the handle stands for");
  if (!cursor_.ends_word()) {
    return fail(cursor_.position(), "expected a blank or the end of the line behind a tag");
  }
  Token token{TokenKind::TagDirective, at, keep(std::move(handle)), {}};
  token.suffix = keep(std::move(prefix));
  tokens_.push_back(token);
  last_ = token.kind;
  return true;
}

}  // namespace kinefile::text::yaml
