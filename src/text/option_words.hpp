// SPDX-License-Identifier: MIT
// Helpers to make the entries of option tables, and to read their words.
#pragma once

#include <charconv>
#include <cmath>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "kinefile/option.hpp"
#include "text/numbers.hpp"

namespace kinefile::words {

/// The parts of a text between separators; an empty text has none.
inline std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t at = text.find(separator);
    parts.emplace_back(text.substr(0, at));
    if (at == std::string_view::npos) break;
    text.remove_prefix(at + 1);
  }
  return parts;
}

/// Reads a whole text as an integer; empty if it is not one.
template <class Integer>
std::optional<Integer> integer(std::string_view text) {
  Integer number{};
  const char* end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && next == end ? std::optional(number) : std::nullopt;
}

/// Reads a whole text as a finite number; empty if it is not one.
inline std::optional<double> finite(std::string_view text) {
  const text::Number number = text::parse_number(text);
  const bool is_good = number.fault == text::NumberFault::None && std::isfinite(number.value);
  return is_good ? std::optional(number.value) : std::nullopt;
}

/// Whether a number is within the limits of an option.
inline bool is_within(const OptionInfo& info, double number) {
  return number >= info.least && number <= info.most;
}

/// Reads the word of an option as a value of some type; empty if the option does not accept it.
template <class Value>
std::optional<Value> value_of(const OptionInfo& info, std::string_view word) {
  if constexpr (std::is_same_v<Value, bool>) {
    return true;
  } else if constexpr (std::is_enum_v<Value>) {
    for (std::size_t i = 0; i < info.choices.size(); ++i) {
      if (info.choices[i] == word) return static_cast<Value>(i);
    }
    return std::nullopt;
  } else if constexpr (std::is_same_v<Value, double>) {
    const auto number = finite(word);
    return number && is_within(info, *number) ? number : std::nullopt;
  } else if constexpr (std::is_integral_v<Value>) {
    const auto number = integer<Value>(word);
    return number && is_within(info, static_cast<double>(*number)) ? number : std::nullopt;
  } else if constexpr (std::is_same_v<Value, std::vector<std::string>>) {
    return word.empty() ? std::nullopt : std::optional(split(word, ','));
  } else {
    static_assert(std::is_same_v<Value, std::string>);
    bool is_known = info.choices.empty();
    for (const std::string_view choice : info.choices) is_known = is_known || choice == word;
    const bool is_missing = word.empty() && info.is_required;
    return is_known && !is_missing ? std::optional(std::string(word)) : std::nullopt;
  }
}

/// Reads a word into a member; false, and the member is unchanged, if the option does not accept
/// it.
template <class Value>
bool read_into(Value& member, const OptionInfo& info, std::string_view word) {
  auto value = value_of<Value>(info, word);
  if (value) member = std::move(*value);
  return value.has_value();
}

/// As above. A required part of an operation's word may be empty, which means no value: `trim=:B`.
template <class Value>
bool read_into(std::optional<Value>& member, const OptionInfo& info, std::string_view word) {
  if (word.empty() && info.is_required) {
    member.reset();
    return true;
  }
  Value value{};
  if (!read_into(value, info, word)) return false;
  member = std::move(value);
  return true;
}

/// The struct that a member belongs to.
template <class Owner, class Value>
Owner owner_of(Value Owner::*);

template <auto Member>
using OwnerOf = decltype(owner_of(Member));

/// An option that sets a member of a struct.
template <auto Member>
constexpr Option<OwnerOf<Member>> option(const OptionInfo& info) {
  return {info, [](OwnerOf<Member>& target, const OptionInfo& own, std::string_view word) {
            return read_into(target.*Member, own, word);
          }};
}

/// An option of `Target`, which is `ReadOptions` or `WriteOptions`, that sets a member of a
/// format's own struct.
template <class Target, auto Member>
constexpr Option<Target> format_option(const OptionInfo& info) {
  return {info, [](Target& target, const OptionInfo& own, std::string_view word) {
            return read_into(target.of_formats.template edit<OwnerOf<Member>>().*Member, own, word);
          }};
}

}  // namespace kinefile::words
