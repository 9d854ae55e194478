// SPDX-License-Identifier: MIT
#include "text/csv_fields.hpp"

#include <algorithm>

#include "text/numbers.hpp"

namespace kinefile::text {

std::vector<CsvField> CsvFields::take_record() {
  std::vector<CsvField> fields;
  do {
    fields.push_back(take_field());
  } while (take_comma());
  take_line_end();
  return fields;
}

CsvField CsvFields::take_field() {
  CsvField field{{}, next_};
  const bool is_quoted = next_ != end_ && *next_ == '"';
  if (is_quoted) take_quoted(field.text);
  const char* const first = next_;
  while (next_ != end_ && *next_ != ',' && !is_line_end(*next_)) ++next_;
  if (is_quoted && fault_ == nullptr && !std::all_of(first, next_, is_blank)) fault_ = first;
  field.text.append(first, next_);
  return field;
}

void CsvFields::take_quoted(std::string& text) {
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

std::optional<std::string_view> CsvFields::take_plain() {
  if (next_ != end_ && *next_ == '"') return std::nullopt;
  const char* first = next_;
  while (next_ != end_ && *next_ != ',' && !is_line_end(*next_)) ++next_;
  const char* last = next_;
  while (first != last && is_blank(*first)) ++first;
  while (last != first && is_blank(last[-1])) --last;
  return std::string_view(first, static_cast<std::size_t>(last - first));
}

bool CsvFields::take_comma() {
  const bool is_next = next_ != end_ && *next_ == ',';
  next_ += is_next;
  return is_next;
}

bool CsvFields::take_line_end() {
  if (next_ == end_) return true;
  const bool has_return = *next_ == '\r';
  next_ += has_return;
  const bool has_feed = next_ != end_ && *next_ == '\n';
  next_ += has_feed;
  return has_return || has_feed;
}

}  // namespace kinefile::text
