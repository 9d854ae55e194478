// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <utility>

namespace kinefile::fuzz {

/// Changes texts where their format most often allows it: another number, a line that is repeated,
/// gone or elsewhere, a word of the same file in place of another. Most of these are read, while
/// most changes of single bytes are refused.
class TextMutator {
 public:
  TextMutator(std::string_view text, unsigned seed) : text_(text), random_(seed) {}

  std::string mutated() {
    const std::size_t kind = below(8);
    if (kind < 4) {
      change_number();
    } else if (kind < 6) {
      change_lines();
    } else {
      const auto [from, length] = part_at(below(text_.size() + 1), kBlanks);
      const auto [other, other_length] = part_at(below(text_.size() + 1), kBlanks);
      text_.replace(from, length, text_.substr(other, other_length));
    }
    return text_;
  }

 private:
  static constexpr std::string_view kBlanks = " \t\r\n,[]{}()<>\"'/=:";

  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }

  /// The part between two of these characters that a place is in.
  std::pair<std::size_t, std::size_t> part_at(std::size_t at, std::string_view borders) const {
    const std::size_t before = at == 0 ? std::string::npos : text_.find_last_of(borders, at - 1);
    const std::size_t from = before == std::string::npos ? 0 : before + 1;
    return {from, std::min(text_.find_first_of(borders, from), text_.size()) - from};
  }

  void change_number() {
    static constexpr const char* kNumbers[] = {
        "0",   "1",     "2",      "-1",     "-0",   "0.5",   "90",   "180", "-179.99", "1e300",
        "nan", "1e-9",  "1e-300", "1e-320", "1e9",  "1e155", "-inf", "10",  "100",     "0.0333333",
        "7",   "65535", "-32768", "0.1",    "1e16", "0x10",  "1e39", "239", "3.5",     "29.97"};
    const std::size_t at = text_.find_first_of("0123456789", below(text_.size()));
    if (at == std::string::npos) return;
    const auto [from, length] = part_at(at, kBlanks);
    text_.replace(from, length, kNumbers[below(std::size(kNumbers))]);
  }

  void change_lines() {
    const auto [from, length] = part_at(below(text_.size()), "\n");
    const std::string line = text_.substr(from, std::min(length + 1, text_.size() - from));
    const std::size_t kind = below(3);
    if (kind > 0) text_.erase(from, line.size());
    if (kind < 2) text_.insert(part_at(below(text_.size() + 1), "\n").first, line);
  }

  std::string text_;
  std::minstd_rand random_;
};

}  // namespace kinefile::fuzz
