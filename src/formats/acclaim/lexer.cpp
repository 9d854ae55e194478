// SPDX-License-Identifier: MIT
#include "formats/acclaim/lexer.hpp"

#include <algorithm>

#include "text/numbers.hpp"
#include "text/scanner.hpp"

namespace kinefile::acclaim {
namespace {

constexpr bool is_separator(char c) {
  return text::is_blank(c) || c == '(' || c == ')' || c == ',';
}

std::string_view view_of(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

void Lexer::skip_in_line() {
  while (next_ != end_ && is_separator(*next_)) ++next_;
  if (next_ != end_ && *next_ == '#') next_ = std::find_if(next_, end_, text::is_line_end);
}

std::string_view Lexer::word_here() const {
  const char* word_end = next_;
  while (word_end != end_ && !is_separator(*word_end) && !text::is_line_end(*word_end)) {
    // Microsoft's C library writes 1.#IND and 1.#INF, which are not comments.
    if (*word_end == '#' && (word_end == next_ || word_end[-1] != '.')) break;
    ++word_end;
  }
  const std::string_view word = view_of(next_, word_end);
  // And nan(ind), where the parentheses belong to the word.
  const bool is_nan = word.size() >= 3 && word.size() <= 4 &&
                      text::equals_ignoring_case(word.substr(word.size() - 3), "nan");
  if (!is_nan || word_end == end_ || *word_end != '(') return word;
  const char* close = std::find_if(
      word_end, end_, [](char c) { return c == ')' || text::is_blank(c) || text::is_line_end(c); });
  return close != end_ && *close == ')' ? view_of(next_, close + 1) : word;
}

std::string_view Lexer::peek() {
  skip_in_line();
  while (next_ != end_ && text::is_line_end(*next_)) {
    ++next_;
    skip_in_line();
  }
  return word_here();
}

std::string_view Lexer::take() {
  const std::string_view word = peek();
  next_ += word.size();
  return word;
}

std::string_view Lexer::peek_in_line() {
  skip_in_line();
  return word_here();
}

std::string_view Lexer::take_in_line() {
  const std::string_view word = peek_in_line();
  next_ += word.size();
  return word;
}

std::string_view Lexer::take_line() {
  const char* begin = std::find_if_not(next_, end_, text::is_blank);
  next_ = std::find_if(begin, end_, text::is_line_end);
  const char* last = next_;
  while (last != begin && text::is_blank(last[-1])) --last;
  return view_of(begin, last);
}

std::string_view Lexer::take_lines_to_keyword() {
  const char* begin = next_;
  const char* last = begin;  // the end of the last line that was consumed
  while (next_ != end_) {
    const char* word = std::find_if_not(next_, end_, text::is_blank);
    if (word != end_ && *word == ':') break;
    last = std::find_if(word, end_, text::is_line_end);
    next_ = last;
    if (next_ != end_ && *next_ == '\r') ++next_;
    if (next_ != end_ && *next_ == '\n') ++next_;
  }
  return view_of(begin, last);
}

}  // namespace kinefile::acclaim
