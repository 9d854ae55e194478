// SPDX-License-Identifier: MIT
#include "formats/wrl/lexer.hpp"

#include <algorithm>

#include "text/numbers.hpp"

namespace kinefile::wrl {
namespace {

bool is_space(char c) { return text::is_blank(c) || text::is_line_end(c) || c == ','; }

bool is_sign(char c) { return c == '{' || c == '}' || c == '[' || c == ']'; }

bool ends_word(char c) { return is_space(c) || is_sign(c) || c == '"' || c == '#'; }

/// The end of a string that starts with a quote: after its closing quote, or the end of the text.
const char* end_of_string(const char* begin, const char* end) {
  for (const char* p = begin + 1; p != end; ++p) {
    if (*p == '"') return p + 1;
    if (*p == '\\' && p + 1 != end) ++p;
  }
  return end;
}

}  // namespace

Token Lexer::take() {
  const Token token = token_;
  advance();
  return token;
}

void Lexer::advance() {
  while (next_ != end_ && (is_space(*next_) || *next_ == '#')) {
    next_ = *next_ == '#' ? std::find_if(next_, end_, text::is_line_end) : next_ + 1;
  }
  const char* const begin = next_;
  if (begin == end_) {
    token_ = {TokenKind::End, {begin, static_cast<std::size_t>(end_ - begin)}};
    return;
  }
  TokenKind kind = TokenKind::Word;
  if (*begin == '"') {
    kind = TokenKind::String;
    next_ = end_of_string(begin, end_);
  } else if (is_sign(*begin)) {
    kind = TokenKind::Sign;
    ++next_;
  } else {
    next_ = std::find_if(begin, end_, ends_word);
  }
  token_ = {kind, {begin, static_cast<std::size_t>(next_ - begin)}};
}

std::string_view find_header(std::string_view text) {
  const char* const end = text.data() + text.size();
  for (const char* p = text.data(); p != end;) {
    const bool is_blank = text::is_blank(*p) || text::is_line_end(*p);
    if (!is_blank && *p != '#') return {};
    const char* const line_end = is_blank ? p + 1 : std::find_if(p, end, text::is_line_end);
    const std::string_view line(p, static_cast<std::size_t>(line_end - p));
    if (line.starts_with("#VRML")) return line;
    p = line_end;
  }
  return {};
}

std::string content_of(const Token& string) {
  std::string_view inner = string.text.substr(1);
  if (inner.ends_with('"')) inner.remove_suffix(1);
  std::string content;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    if (inner[i] == '\\' && i + 1 < inner.size()) ++i;
    content += inner[i];
  }
  return content;
}

}  // namespace kinefile::wrl
