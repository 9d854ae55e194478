// SPDX-License-Identifier: MIT
// Scalars: plain, quoted, and blocks of text (YAML 1.1, chapter 9).

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "text/decode.hpp"
#include "text/yaml/scanner.hpp"

namespace kinefile::text::yaml {
namespace {

/// The value of a hexadecimal digit; 16 for other characters.
std::uint32_t hex_digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<std::uint32_t>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<std::uint32_t>(c - 'a' + 10);
  if (c >= 'A' && c <= 'F') return static_cast<std::uint32_t>(c - 'A' + 10);
  return 16;
}

/// The meaning of a one-letter escape; null if there is none.
const char* simple_escape(char c) {
  constexpr std::array<std::pair<char, const char*>, 17> kEscapes = {{
      {'a', "\a"},
      {'b', "\b"},
      {'t', "\t"},
      {'\t', "\t"},
      {'n', "\n"},
      {'v', "\v"},
      {'f', "\f"},
      {'r', "\r"},
      {'e', "\x1B"},
      {' ', " "},
      {'"', "\""},
      {'/', "/"},
      {'\\', "\\"},
      {'N', "\xC2\x85"},
      {'_', "\xC2\xA0"},
      {'L', "\xE2\x80\xA8"},
      {'P', "\xE2\x80\xA9"},
  }};
  for (const auto& [letter, text] : kEscapes) {
    if (letter == c) return text;
  }
  return nullptr;
}

/// The line breaks between two lines of a folded scalar: one becomes a blank; of several the first
/// is dropped.
struct Fold {
  std::string first;
  std::string others;
  bool has_break = false;

  void add_to(std::string& out) {
    if (first.starts_with('\n')) {
      out += others.empty() ? " " : others;
    } else {
      out += first + others;  // LS and PS are unchanged
    }
    first.clear();
    others.clear();
    has_break = false;
  }
};

}  // namespace

/// Skips a line break and adds it as LF; LS and PS are unchanged.
void Scanner::take_break(std::string& out) {
  const std::size_t width = cursor_.break_width();
  if (width == 3) {
    out.append(cursor_.position(), width);
  } else if (width > 0) {
    out += '\n';
  }
  cursor_.skip_break();
}

void Scanner::take_line_rest(std::string& out) {
  const char* const first = cursor_.position();
  while (!cursor_.is_at_end() && !cursor_.is_break()) cursor_.skip();
  out.append(first, cursor_.position());
}

bool Scanner::scan_plain(Token& token) {
  const bool is_in_flow = candidates_.size() > 1;
  const std::ptrdiff_t indent = indent_ + 1;
  std::string folded;  // the lines that were joined so far
  bool is_folded = false;
  Fold fold;
  const char* const start = cursor_.position();
  const char* word_end = start;
  const char* blanks = start;  // the blanks between two words of a line start here
  while (true) {
    if (cursor_.column() == 0 && (cursor_.is_document_mark('-') || cursor_.is_document_mark('.'))) {
      break;
    }
    if (cursor_.peek() == '#') break;
    const char* const word = cursor_.position();
    while (!cursor_.ends_word()) {
      const char c = cursor_.peek();
      if (c == ':') {
        const char next = cursor_.peek(1);
        if (is_in_flow && next != '\0' && std::strchr(",?[]{}", next) != nullptr) {
          return fail(cursor_.position(), "expected no ':' within a word");
        }
        if (cursor_.ends_word(1)) break;
      }
      if (is_in_flow && c != '\0' && std::strchr(",[]{}", c) != nullptr) break;
      cursor_.skip();
    }
    if (cursor_.position() == word) break;
    if (fold.has_break) {
      if (!is_folded) folded.assign(start, word_end);
      is_folded = true;
      fold.add_to(folded);
    } else if (is_folded) {
      folded.append(blanks, word);
    }
    if (is_folded) folded.append(word, cursor_.position());
    word_end = blanks = cursor_.position();
    if (!cursor_.is_blank() && !cursor_.is_break()) break;
    while (cursor_.is_blank() || cursor_.is_break()) {
      if (cursor_.is_break()) {
        take_break(fold.has_break ? fold.others : fold.first);
        fold.has_break = true;
        continue;
      }
      if (fold.has_break && cursor_.peek() == '\t' &&
          static_cast<std::ptrdiff_t>(cursor_.column()) < indent) {
        return fail(cursor_.position(), "expected blanks as indentation, found a tab");
      }
      cursor_.skip();
    }
    if (!is_in_flow && static_cast<std::ptrdiff_t>(cursor_.column()) < indent) break;
  }
  token.value = is_folded ? keep(std::move(folded))
                          : std::string_view(start, static_cast<std::size_t>(word_end - start));
  if (fold.has_break) allows_key_ = true;
  return true;
}

bool Scanner::scan_quoted(Token& token) {
  const bool is_single = token.style == ScalarStyle::SingleQuoted;
  const char quote = is_single ? '\'' : '"';
  const char* const start = cursor_.position();
  cursor_.skip();
  std::string value;
  Fold fold;
  while (true) {
    if (cursor_.column() == 0 && (cursor_.is_document_mark('-') || cursor_.is_document_mark('.'))) {
      return fail(cursor_.position(), "expected the end of a quoted text before the document's");
    }
    if (cursor_.is_at_end()) return fail(start, "expected the end of this quoted text");
    bool has_break = false;  // an escaped line break
    while (!cursor_.ends_word()) {
      const char c = cursor_.peek();
      if (is_single && c == '\'' && cursor_.peek(1) == '\'') {
        value += '\'';
        cursor_.skip(2);
      } else if (c == quote) {
        break;
      } else if (!is_single && c == '\\' && cursor_.is_break(1)) {
        cursor_.skip();
        cursor_.skip_break();
        has_break = true;
        break;
      } else if (!is_single && c == '\\') {
        if (!scan_escape(value)) return false;
      } else {
        value += c;
        cursor_.skip();
      }
    }
    if (cursor_.peek() == quote) break;
    const char* blanks = cursor_.position();
    while (cursor_.is_blank() || cursor_.is_break()) {
      if (cursor_.is_break()) {
        // The blanks between the last word and the break are dropped.
        if (has_break || fold.has_break) {
          take_break(fold.others);
        } else {
          take_break(fold.first);
        }
        fold.has_break = has_break = true;
        blanks = cursor_.position();
      } else {
        cursor_.skip();
      }
    }
    if (has_break) {
      fold.add_to(value);
    } else {
      value.append(blanks, cursor_.position());
    }
  }
  cursor_.skip();
  token.value = keep(std::move(value));
  return true;
}

bool Scanner::scan_escape(std::string& value) {
  const char* const at = cursor_.position();
  const char c = cursor_.peek(1);
  cursor_.skip();
  if (cursor_.is_at_end()) return fail(at, "expected a character behind '\\'");
  if (c == '0') {
    value += '\0';
    cursor_.skip();
    return true;
  }
  if (const char* text = simple_escape(c)) {
    value += text;
    cursor_.skip();
    return true;
  }
  const std::size_t num_digits = c == 'x' ? 2 : c == 'u' ? 4 : c == 'U' ? 8 : 0;
  if (num_digits == 0) return fail(at, "expected a known escape sequence");
  cursor_.skip();
  std::uint32_t code = 0;
  for (std::size_t i = 0; i < num_digits; ++i) {
    const std::uint32_t digit = hex_digit(cursor_.peek());
    if (digit == 16) return fail(at, fmt::format("expected {} hexadecimal digits", num_digits));
    code = code * 16 + digit;
    cursor_.skip();
  }
  if ((code >= 0xD800 && code <= 0xDFFF) || code > 0x10FFFF) {
    return fail(at, "expected the code of a character");
  }
  append_utf8(value, code);
  return true;
}

/// Reads the header after | or >: how to treat the last line breaks (-1: remove all, 1: keep all),
/// and the indentation of the text (0: that of its first line).
bool Scanner::scan_block_header(int& chomping, std::size_t& increment) {
  const char* const at = cursor_.position();
  cursor_.skip();
  const auto take_chomping = [&] {
    const char c = cursor_.peek();
    if (c != '+' && c != '-') return false;
    chomping = c == '+' ? 1 : -1;
    cursor_.skip();
    return true;
  };
  const auto take_increment = [&] {
    const char c = cursor_.peek();
    if (c < '0' || c > '9') return false;
    increment = static_cast<std::size_t>(c - '0');
    cursor_.skip();
    return true;
  };
  bool has_increment = false;
  if (take_chomping()) {
    has_increment = take_increment();
  } else if (take_increment()) {
    has_increment = true;
    take_chomping();
  }
  if (has_increment && increment == 0) return fail(at, "expected an indentation from 1 to 9");
  while (cursor_.is_blank()) cursor_.skip();
  if (cursor_.peek() == '#') skip_comment();
  if (!cursor_.is_at_end() && !cursor_.is_break()) {
    return fail(cursor_.position(), "expected a comment or the end of the line");
  }
  if (cursor_.is_break()) cursor_.skip_break();
  return true;
}

/// Consumes empty lines and the indentation of the next line; determines the indentation if it is
/// 0.
bool Scanner::scan_block_breaks(std::size_t& indent, std::string& breaks) {
  std::size_t deepest = 0;
  while (true) {
    while ((indent == 0 || cursor_.column() < indent) && cursor_.peek() == ' ') cursor_.skip();
    deepest = std::max(deepest, cursor_.column());
    if ((indent == 0 || cursor_.column() < indent) && cursor_.peek() == '\t') {
      return fail(cursor_.position(), "expected blanks as indentation, found a tab");
    }
    if (!cursor_.is_break()) break;
    take_break(breaks);
  }
  if (indent == 0) {
    indent = std::max({deepest, static_cast<std::size_t>(indent_ + 1), std::size_t{1}});
  }
  return true;
}

bool Scanner::scan_block(Token& token) {
  const bool is_literal = token.style == ScalarStyle::Literal;
  int chomping = 0;
  std::size_t increment = 0;
  if (!scan_block_header(chomping, increment)) return false;
  std::size_t indent = 0;
  if (increment > 0) {
    indent = indent_ >= 0 ? static_cast<std::size_t>(indent_) + increment : increment;
  }
  std::string value, first_break, breaks;
  if (!scan_block_breaks(indent, breaks)) return false;
  bool was_blank = false;
  while (cursor_.column() == indent && !cursor_.is_at_end()) {
    // Lines that start with a blank are not folded, nor are their neighbours.
    const bool is_blank = cursor_.is_blank();
    if (!is_literal && first_break.starts_with('\n') && !was_blank && !is_blank) {
      if (breaks.empty()) value += ' ';
      first_break.clear();
    }
    value += first_break;
    first_break.clear();
    value += breaks;
    breaks.clear();
    was_blank = is_blank;
    take_line_rest(value);
    if (cursor_.is_break()) take_break(first_break);
    if (!scan_block_breaks(indent, breaks)) return false;
  }
  if (chomping >= 0) value += first_break;
  if (chomping > 0) value += breaks;
  token.value = keep(std::move(value));
  return true;
}

}  // namespace kinefile::text::yaml
