// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

#include "text/numbers.hpp"

namespace kinefile::text::yaml {

/// A cursor in a text. Beyond the end it sees zero characters.
class Cursor {
 public:
  explicit Cursor(std::string_view text)
      : begin_(text.data()), next_(begin_), end_(begin_ + text.size()), counted_(begin_) {}

  const char* position() const { return next_; }
  const char* end() const { return end_; }
  bool is_at_end() const { return next_ == end_; }

  /// The character `ahead` bytes further on, or zero beyond the end.
  char peek(std::ptrdiff_t ahead = 0) const { return ahead < end_ - next_ ? next_[ahead] : '\0'; }

  /// The number of bytes of a line break `ahead` bytes further on, or 0: LF, CR, CRLF, NEL, LS, PS.
  std::size_t break_width(std::ptrdiff_t ahead = 0) const;
  bool is_break(std::ptrdiff_t ahead = 0) const { return break_width(ahead) > 0; }
  bool is_blank(std::ptrdiff_t ahead = 0) const {
    const char c = peek(ahead);
    return c == ' ' || c == '\t';
  }
  /// Whether a word ends here: a blank, a line break, the end of the text.
  bool ends_word(std::ptrdiff_t ahead = 0) const {
    return is_blank(ahead) || ahead >= end_ - next_ || is_break(ahead);
  }
  /// Whether a byte order mark comes next.
  bool is_byte_order_mark() const {
    return peek() == '\xEF' && peek(1) == '\xBB' && peek(2) == '\xBF';
  }
  /// Whether "---" or "..." is here as a separate word.
  bool is_document_mark(char c) const {
    return peek() == c && peek(1) == c && peek(2) == c && ends_word(3);
  }

  /// Skips bytes of a line.
  void skip(std::size_t bytes = 1) { next_ += bytes; }
  /// Skips a line break and starts a line.
  void skip_break();
  /// Skips ASCII characters up to a later place; `line_starts` lines start on the way, the last one
  /// at `last_start`.
  void jump(const char* to, std::size_t line_starts, const char* last_start);

  std::size_t line() const { return line_; }
  /// Characters since the start of the line.
  std::size_t column() const { return index() - line_start_; }
  /// Characters since the start of the text; breaks and marks count as one.
  std::size_t index() const;

 private:
  const char* begin_;
  const char* next_;
  const char* end_;
  std::size_t line_ = 0;
  std::size_t line_start_ = 0;  ///< in characters
  mutable const char* counted_;
  mutable std::size_t count_ = 0;  ///< the number of characters before `counted_`
};

/// The first character that YAML does not allow in a part of a text, or null: control characters,
/// U+FFFE.
const char* find_forbidden_character(std::string_view part, const char* text_end);

}  // namespace kinefile::text::yaml
