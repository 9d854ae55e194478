// SPDX-License-Identifier: MIT
#include "formats/robovie/settings.hpp"

#include <algorithm>
#include <cstdint>

#include "text/numbers.hpp"
#include "text/source.hpp"

namespace kinefile::robovie {
namespace {

/// Walks over a line and fills a setting.
class Splitter {
 public:
  Splitter(std::string_view line, Setting& setting)
      : next_(line.data()), end_(line.data() + line.size()), setting_(setting) {
    while (end_ > next_ && text::is_blank(end_[-1])) --end_;
    if (end_ < line.data() + line.size()) setting_.first_blank = end_;
    skip_blanks();
    setting_.at = next_;
    setting_.end = end_;
  }

  void split() {
    if (!take_key()) return;
    skip_blanks();
    if (next_ == end_) return;
    do {
      skip_blanks();
      if (!take_field()) return;
      skip_blanks();
    } while (next_ < end_ && take('-', "'-'"));
  }

 private:
  std::string_view rest() const { return {next_, static_cast<std::size_t>(end_ - next_)}; }

  void skip_blanks() {
    if (next_ < end_ && text::is_blank(*next_) &&
        (setting_.first_blank == nullptr || next_ < setting_.first_blank)) {
      setting_.first_blank = next_;
    }
    while (next_ < end_ && text::is_blank(*next_)) ++next_;
  }

  bool fail_at(const char* at, std::string_view expected) {
    setting_.fault = at;
    setting_.expected_at_fault = expected;
    return false;
  }

  bool take(char c, std::string_view expected) {
    if (next_ == end_ || *next_ != c) return fail_at(next_, expected);
    ++next_;
    return true;
  }

  bool take_key() {
    const std::size_t colon = rest().find_first_of(":[");
    if (colon == std::string_view::npos || rest()[colon] != ':') {
      // The character in place of the colon is often a full-width one.
      const std::string_view before = rest().substr(0, colon);
      setting_.key = before.substr(0, before.find("\uFF1A"));
      return fail_at(next_ + setting_.key.size(), "':'");
    }
    setting_.key = rest().substr(0, colon);
    next_ += colon + 1;
    return true;
  }

  bool take_field() {
    const char* const at = next_;
    if (!take('[', "'['")) return false;
    const bool is_doubled = next_ < end_ && *next_ == '[';
    if (is_doubled) ++next_;
    const std::size_t length = is_doubled ? length_of_text() : rest().find_first_of("[]");
    if (is_doubled && length == std::string_view::npos)
      return fail_at(end_, "']]', followed by '-[' or nothing");
    if (length == std::string_view::npos) return fail_at(end_, "']'");
    if (!is_doubled && rest()[length] == '[') return fail_at(next_ + length, "']'");
    setting_.fields.push_back({rest().substr(0, length), at, is_doubled});
    next_ += length + (is_doubled ? 2 : 1);
    return true;
  }

  std::size_t length_of_text() const {
    const std::string_view text = rest();
    for (std::size_t close = text.find("]]"); close != std::string_view::npos;
         close = text.find("]]", close + 1)) {
      const std::string_view behind = text.substr(close + 2);
      if (behind.empty() || behind.starts_with("-[")) return close;
    }
    return std::string_view::npos;
  }

  const char* next_;
  const char* end_;
  Setting& setting_;
};

}  // namespace

void split_setting(std::string_view line, Setting& setting) {
  setting.fields.clear();
  setting.key = {};
  setting.first_blank = setting.fault = nullptr;
  Splitter(line, setting).split();
}

bool Lines::next(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
  line = rest_.substr(0, end);
  rest_.remove_prefix(end);
  rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : rest_.empty() ? 0 : 1);
  return true;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text::is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && text::is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::optional<int> parse_integer(std::string_view text) {
  text = trimmed(text);
  const bool is_negative = text.starts_with('-');
  if (is_negative || text.starts_with('+')) text.remove_prefix(1);
  if (text.empty()) return std::nullopt;
  std::int64_t value = 0;
  for (const char c : text) {
    if (c < '0' || c > '9') return std::nullopt;
    value = value * 10 + (c - '0');
    if (value > kLargestNumber) return std::nullopt;
  }
  return static_cast<int>(is_negative ? -value : value);
}

char narrow_form(std::string_view text, std::size_t& length) {
  struct Pair {
    std::string_view wide;
    char narrow;
  };
  // Minus, hyphens, dashes and the long vowel sign are typed instead of '-', the Japanese comma
  // instead of ','.
  constexpr Pair kOthers[] = {{"\u2212", '-'}, {"\u2010", '-'}, {"\u2013", '-'}, {"\u2014", '-'},
                              {"\u2015", '-'}, {"\u30FC", '-'}, {"\u3001", ','}, {"\u3000", ' '}};
  for (const Pair& pair : kOthers) {
    if (text.starts_with(pair.wide)) {
      length = pair.wide.size();
      return pair.narrow;
    }
  }
  // U+FF01 to U+FF5E are full-width forms of '!' to '~'.
  if (text.size() < 3 || text[0] != '\xEF') return 0;
  const auto second = static_cast<unsigned char>(text[1]);
  const auto third = static_cast<unsigned char>(text[2]);
  const unsigned code = 0xF000u | ((second & 0x3Fu) << 6) | (third & 0x3Fu);
  length = 3;
  return code >= 0xFF01 && code <= 0xFF5E ? static_cast<char>(code - 0xFF01 + '!') : '\0';
}

std::size_t find_full_width(std::string_view text) {
  std::size_t ignored = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_ascii = (static_cast<unsigned char>(text[i]) & 0x80) == 0;
    if (!is_ascii && narrow_form(text.substr(i), ignored) != 0) return i;
  }
  return std::string_view::npos;
}

std::string shown(std::string_view token) {
  return token.empty() ? "the end of the line" : text::quoted(token);
}

}  // namespace kinefile::robovie
