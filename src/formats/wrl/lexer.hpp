// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace kinefile::wrl {

enum class TokenKind {
  End,
  Word,    ///< a name, a keyword or a number
  String,  ///< in quotes
  Sign,    ///< one of { } [ ]
};

struct Token {
  TokenKind kind = TokenKind::End;
  std::string_view text;  ///< for a string with its quotes; empty at the end

  const char* at() const { return text.data(); }
  bool is(std::string_view other) const { return kind != TokenKind::String && text == other; }
};

/// Cuts a VRML text into tokens, which are views into it. Commas are blanks, # starts a comment.
/// Source: ISO/IEC 14772-1, 4.1 and annex A.
class Lexer {
 public:
  explicit Lexer(std::string_view text) : next_(text.data()), end_(text.data() + text.size()) {
    advance();
  }

  const Token& peek() const { return token_; }
  Token take();

 private:
  void advance();

  const char* next_;
  const char* end_;
  Token token_;
};

/// The header "#VRML V2.0 utf8" up to the end of its line, if blanks, empty lines and comments
/// alone are before it; otherwise empty.
std::string_view find_header(std::string_view text);

/// The content of a string token: without its quotes and the backslashes before characters.
std::string content_of(const Token& string);

}  // namespace kinefile::wrl
