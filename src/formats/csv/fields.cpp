// SPDX-License-Identifier: MIT
#include "formats/csv/fields.hpp"

#include <algorithm>

#include "text/numbers.hpp"

namespace kinefile::csv {

std::vector<Field> Fields::take_record() {
  std::vector<Field> fields;
  do {
    fields.push_back(take_field());
  } while (take_comma());
  take_line_end();
  return fields;
}

Field Fields::take_field() {
  Field field{{}, next_};
  const bool is_quoted = next_ != end_ && *next_ == '"';
  if (is_quoted) take_quoted(field.text);
  const char* const first = next_;
  while (next_ != end_ && *next_ != ',' && !text::is_line_end(*next_)) ++next_;
  if (is_quoted && fault_ == nullptr && !std::all_of(first, next_, text::is_blank)) fault_ = first;
  field.text.append(first, next_);
  return field;
}

void Fields::take_quoted(std::string& text) {
  const char* const opening = next_++;
  while (next_ != end_) {
    const char c = *next_++;
    const bool is_quote = c == '"';
    if (is_quote && (next_ == end_ || *next_ != '"')) return;
    next_ += is_quote;
    text += c;
  }
  if (fault_ == nullptr) fault_ = opening;
}

std::optional<std::string_view> Fields::take_plain() {
  if (next_ != end_ && *next_ == '"') return std::nullopt;
  const char* first = next_;
  while (next_ != end_ && *next_ != ',' && !text::is_line_end(*next_)) ++next_;
  const char* last = next_;
  while (first != last && text::is_blank(*first)) ++first;
  while (last != first && text::is_blank(last[-1])) --last;
  return std::string_view(first, static_cast<std::size_t>(last - first));
}

bool Fields::take_comma() {
  const bool is_next = next_ != end_ && *next_ == ',';
  next_ += is_next;
  return is_next;
}

bool Fields::take_line_end() {
  if (next_ == end_) return true;
  const bool has_return = *next_ == '\r';
  next_ += has_return;
  const bool has_feed = next_ != end_ && *next_ == '\n';
  next_ += has_feed;
  return has_return || has_feed;
}

}  // namespace kinefile::csv
