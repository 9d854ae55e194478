// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace kinefile::acclaim {

/// Walks over an Acclaim text word by word. Blanks, line ends, parentheses and commas separate
/// words, and # starts a comment that ends with the line. Words are views into the text.
class Lexer {
 public:
  explicit Lexer(std::string_view text) : next_(text.data()), end_(text.data() + text.size()) {}

  const char* position() const { return next_; }
  void move_to(const char* position) { next_ = position; }

  /// The next word, over any number of lines; empty at the end of the text.
  std::string_view peek();
  std::string_view take();
  /// The next word of this line; empty at its end.
  std::string_view peek_in_line();
  std::string_view take_in_line();
  /// Consumes the rest of the line unchanged, with comments but without its end; trims its blanks.
  std::string_view take_line();
  /// Consumes whole lines unchanged up to a line that starts with `:`, or to the end of the text.
  /// The line end before it is consumed, but is not in the result.
  std::string_view take_lines_to_keyword();

 private:
  void skip_in_line();
  std::string_view word_here() const;

  const char* next_;
  const char* end_;
};

}  // namespace kinefile::acclaim
