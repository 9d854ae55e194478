// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace kinefile::text {

/// Reads a text word by word; every word is a view into it. Words end at blanks and line ends; a
/// brace is a separate word.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : next_(text.data()), end_(text.data() + text.size()) {}

  const char* position() const { return next_; }
  void move_to(const char* position) { next_ = position; }

  /// The next word, over any number of lines, without consuming it; empty at the end of the text.
  std::string_view peek();
  /// Consumes the next word, over any number of lines; empty at the end of the text.
  std::string_view take();
  /// The next word of this line, without consuming it; empty at the end of the line.
  std::string_view peek_in_line();
  std::string_view take_in_line();
  /// Consumes the rest of the line, but not its end, and removes blanks at both ends.
  std::string_view take_line();
  /// As `take_line`, but stops before a brace.
  std::string_view take_name();
  /// Consumes this character if it is next in the line, after blanks.
  bool take_character(char c);

 private:
  void skip_blanks();
  void skip_space();
  std::string_view word_here() const;

  const char* next_;
  const char* end_;
};

/// Whether two words are equal, ignoring the case of ASCII letters.
bool equals_ignoring_case(std::string_view a, std::string_view b);

/// Whether a word is in a list, ignoring the case of ASCII letters.
bool is_one_of(std::string_view word, std::span<const std::string_view> words);

/// Whether a text starts with a word, ignoring the case of ASCII letters.
bool starts_with_ignoring_case(std::string_view text, std::string_view prefix);

}  // namespace kinefile::text
