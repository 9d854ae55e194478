// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "formats/robovie/codes.hpp"
#include "formats/robovie/reader.hpp"
#include "model/slider_words.hpp"
#include "text/numbers.hpp"

namespace kinefile::robovie {
namespace {

/// Whether a number is written as by the editor: no plus sign, no leading zeros.
bool is_plain(std::string_view digits) {
  if (digits == "0") return true;
  if (digits.starts_with('-')) digits.remove_prefix(1);
  return !digits.empty() && digits.front() >= '1' && digits.front() <= '9' &&
         !text::is_blank(digits.back());
}

/// A field with its brackets.
std::string shown_field(const Field& field) {
  const std::string_view whole(field.at, field.text.size() + (field.is_doubled ? 4 : 2));
  return shown(whole);
}

void tell_fault(const Reader& reader, const Setting& line) {
  const std::string_view rest(line.fault, static_cast<std::size_t>(line.end - line.fault));
  std::string message = fmt::format("expected {}, found {}", line.expected_at_fault, shown(rest));
  std::size_t length = 0;
  const bool is_wide = narrow_form(rest, length) != 0;
  reader.error(is_wide ? code::kFullWidth : code::kPunctuation, std::move(message), line.fault);
}

}  // namespace

void Reader::repair(const char* code, std::string message, std::string_view done,
                    const char* at) const {
  if (options.lenient) return warn(code, fmt::format("{}; {}", message, done), at);
  error(code, std::move(message), at);
}

void tell_wrong(const Reader& reader, const char* code, std::string message,
                std::string_view text) {
  const std::size_t wide = find_full_width(text);
  if (wide == std::string_view::npos) return reader.error(code, std::move(message), text.data());
  reader.error(code::kFullWidth,
               fmt::format("{}; a character is of full width", std::move(message)),
               text.data() + wide);
}

void tell_spelling(const Reader& reader, std::string_view what, const char* at) {
  reader.warn(code::kSpelling,
              fmt::format("{}: the editor does not write it so, and may not read "
                          "it",
                          what),
              at);
}

bool Settings::are_complete() const {
  if (line_.fault != nullptr) {
    tell_fault(reader_, line_);
    return false;
  }
  const std::size_t wanted = row_.settings.size();
  const std::size_t found = line_.fields.size();
  if (found != wanted) {
    const std::string names = fmt::format("{}", fmt::join(row_.settings, ", "));
    reader_.error(
        code::kNumSettings,
        fmt::format("expected {} setting{} after {}:{}, found {}", wanted, wanted == 1 ? "" : "s",
                    row_.word, names.empty() ? "" : fmt::format(" ({})", names), found),
        found > wanted ? line_.fields[wanted].at : line_.end);
    return false;
  }
  if (line_.first_blank != nullptr) tell_spelling(reader_, "a blank", line_.first_blank);
  return true;
}

std::optional<int> Settings::integer(std::size_t i) const {
  const Field& field = line_.fields[i];
  if (field.is_doubled) {
    reader_.error(code::kDoubledBrackets,
                  fmt::format("expected single brackets round a number ({}), found {}",
                              row_.settings[i], shown_field(field)),
                  field.at);
  }
  const auto value = parse_integer(field.text);
  if (!value) {
    tell_wrong(reader_, code::kNotANumber,
               fmt::format("expected a whole number ({}), found {}", row_.settings[i],
                           field.text.empty() ? "nothing" : shown(field.text)),
               field.text);
  } else if (!is_plain(field.text)) {
    tell_spelling(reader_, fmt::format("the number {}", text::quoted(field.text)),
                  field.text.data());
  }
  return value;
}

int Settings::number(std::size_t i, const Range& range) const {
  const auto value = integer(i);
  if (!value) return range.minimum;
  if (*value < range.minimum || *value > range.maximum) {
    const std::string allowed = range.maximum == kLargestNumber
                                    ? fmt::format("{} or more", range.minimum)
                                    : fmt::format("{} to {}", range.minimum, range.maximum);
    reader_.error(range.code,
                  fmt::format("expected {} ({}), found {}", allowed, row_.settings[i],
                              trimmed(field(i).text)),
                  field(i).text.data());
  }
  return std::clamp(*value, range.minimum, range.maximum);
}

int Settings::ticks(std::size_t i) const {
  const int value = integer(i).value_or(1);
  if (value >= 1 && value <= kMaxTicks) return value;
  const int nearest = std::clamp(value, 1, kMaxTicks);
  reader_.repair(
      code::kBadTime,
      fmt::format("expected 1 to {} ticks (time), found {}", kMaxTicks, trimmed(field(i).text)),
      fmt::format("{} is taken", nearest), field(i).text.data());
  return nearest;
}

std::string Settings::text(std::size_t i) const {
  const Field& field = line_.fields[i];
  if (field.is_doubled) return std::string(field.text);
  reader_.repair(code::kSingleBrackets,
                 fmt::format("expected doubled brackets round a text ({}), found {}",
                             row_.settings[i], shown_field(field)),
                 "no text is taken, as the editor does", field.at);
  return {};
}

std::string_view Settings::single(std::size_t i) const {
  const Field& field = line_.fields[i];
  if (field.is_doubled) {
    reader_.error(code::kDoubledBrackets,
                  fmt::format("expected single brackets round the {}, found {}", row_.settings[i],
                              shown_field(field)),
                  field.at);
  }
  return field.text;
}

std::size_t parse_words(const Reader& reader, const Field& field, std::size_t num_kept,
                        std::vector<SliderWord>& words) {
  std::size_t count = 0;
  bool is_plain = true;
  std::string_view rest = field.text;
  words.reserve(num_kept);
  for (bool goes_on = !trimmed(rest).empty(); goes_on; ++count) {
    const std::size_t comma = rest.find(',');
    goes_on = comma != std::string_view::npos;
    const std::string_view token = rest.substr(0, comma);
    rest.remove_prefix(goes_on ? comma + 1 : rest.size());
    const auto word = parse_word(trimmed(token));
    const bool has_capitals = word && std::any_of(token.begin() + 2, token.end(),
                                                  [](char c) { return c >= 'A' && c <= 'F'; });
    if (!word) {
      tell_wrong(reader, code::kBadWord,
                 fmt::format("expected a word, 0x or 0X and four hexadecimal digits, found {}",
                             token.empty() ? "nothing" : shown(token)),
                 token);
    } else if (is_plain && (has_capitals || token.size() != 6)) {  // reported once per pose
      tell_spelling(reader, fmt::format("the word {}", text::quoted(token)), token.data());
      is_plain = false;
    }
    if (count < num_kept) words.push_back(word.value_or(SliderWord{}));
  }
  return count;
}

const char* place_of_word(const char* words, std::size_t slider) {
  const char* at = words + 1;
  for (; slider > 0; --slider) {
    while (*at != ',') ++at;
    ++at;
  }
  return at;
}

}  // namespace kinefile::robovie
