// SPDX-License-Identifier: MIT
#include "text/scanner.hpp"

#include <algorithm>

#include "base/words.hpp"
#include "text/numbers.hpp"

namespace kinefile::text {
namespace {

constexpr bool is_brace(char c) { return c == '{' || c == '}'; }

std::string_view view_of(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace

void Scanner::skip_blanks() {
  while (next_ != end_ && is_blank(*next_)) ++next_;
}

void Scanner::skip_space() {
  while (next_ != end_ && (is_blank(*next_) || is_line_end(*next_))) ++next_;
}

std::string_view Scanner::word_here() const {
  if (next_ == end_ || is_line_end(*next_)) return view_of(next_, next_);
  if (is_brace(*next_)) return {next_, 1};
  const char* word_end = std::find_if(
      next_, end_, [](char c) { return is_blank(c) || is_line_end(c) || is_brace(c); });
  return view_of(next_, word_end);
}

std::string_view Scanner::peek() {
  skip_space();
  return word_here();
}

std::string_view Scanner::take() {
  const std::string_view word = peek();
  next_ += word.size();
  return word;
}

std::string_view Scanner::peek_in_line() {
  skip_blanks();
  return word_here();
}

std::string_view Scanner::take_in_line() {
  const std::string_view word = peek_in_line();
  next_ += word.size();
  return word;
}

std::string_view Scanner::take_line() {
  const char* begin = next_;
  next_ = std::find_if(next_, end_, is_line_end);
  return trimmed(view_of(begin, next_));
}

std::string_view Scanner::take_name() {
  const char* begin = next_;
  next_ = std::find_if(next_, end_, [](char c) { return is_line_end(c) || is_brace(c); });
  return trimmed(view_of(begin, next_));
}

bool Scanner::take_character(char c) {
  skip_blanks();
  if (next_ == end_ || *next_ != c) return false;
  ++next_;
  return true;
}

bool equals_ignoring_case(std::string_view a, std::string_view b) {
  return a.size() == b.size() && starts_with_ignoring_case(a, b);
}

bool is_one_of(std::string_view word, std::span<const std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [word](std::string_view known) { return equals_ignoring_case(known, word); });
}

bool starts_with_ignoring_case(std::string_view text, std::string_view prefix) {
  if (text.size() < prefix.size()) return false;
  return std::equal(prefix.begin(), prefix.end(), text.begin(),
                    [](char a, char b) { return lowered(a) == lowered(b); });
}

}  // namespace kinefile::text
