// SPDX-License-Identifier: MIT
#include "kinefile/diagnostics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <tuple>

namespace kinefile {

std::string_view severity_name(Severity severity) {
  switch (severity) {
    case Severity::Note:
      return "note";
    case Severity::Warning:
      return "warning";
    case Severity::Error:
      return "error";
  }
  return "";
}

Error make_error(ErrorKind kind, std::string code, std::string message, std::string source) {
  Error error;
  error.kind = kind;
  error.code = std::move(code);
  error.message = std::move(message);
  error.place.source = std::move(source);
  return error;
}

void Diagnostics::add(Diagnostic diagnostic) {
  if (warnings_are_errors && diagnostic.severity == Severity::Warning) {
    diagnostic.severity = Severity::Error;
  }
  if (++counts_[{diagnostic.code, diagnostic.severity}] <= kMaxPerCode) {
    items_.push_back(std::move(diagnostic));
  }
}

void Diagnostics::add(Severity severity, std::string code, std::string message) {
  add(Diagnostic{severity, {}, std::move(code), std::move(message), {}, {}, 0});
}

bool Diagnostics::is_full(const std::string& code, Severity severity) const {
  const bool is_raised = warnings_are_errors && severity == Severity::Warning;
  return count_of(code, is_raised ? Severity::Error : severity) >= kMaxPerCode;
}

void Diagnostics::append(Diagnostics&& other) {
  std::map<std::pair<std::string, Severity>, std::size_t> num_kept;
  for (Diagnostic& item : other.items_) {
    ++num_kept[{item.code, item.severity}];
    add(std::move(item));
  }
  for (const auto& [key, count] : other.counts_) counts_[key] += count - num_kept[key];
  other = {};
}

std::vector<const Diagnostic*> Diagnostics::by_place() const {
  std::vector<const Diagnostic*> sorted;
  sorted.reserve(items_.size());
  for (const Diagnostic& item : items_) sorted.push_back(&item);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Diagnostic* a, const Diagnostic* b) {
    return std::tie(a->place.line, a->place.column) < std::tie(b->place.line, b->place.column);
  });
  return sorted;
}

std::size_t Diagnostics::count(Severity severity) const {
  std::size_t sum = 0;
  for (const auto& [key, count] : counts_) sum += key.second == severity ? count : 0;
  return sum;
}

std::size_t Diagnostics::count_of(const std::string& code, Severity severity) const {
  const auto found = counts_.find({code, severity});
  return found == counts_.end() ? 0 : found->second;
}

Error Diagnostics::first_error() const {
  const auto found = std::find_if(items_.begin(), items_.end(), [](const Diagnostic& item) {
    return item.severity == Severity::Error;
  });
  assert(found != items_.end());
  Error error;
  static_cast<Diagnostic&>(error) = *found;
  return error;
}

Diagnostics named(const Diagnostics& diagnostics, const std::string& source, bool are_strict) {
  Diagnostics all;
  all.warnings_are_errors = are_strict;
  for (Diagnostic item : diagnostics.items()) {
    if (item.place.source.empty()) item.place.source = source;
    all.add(std::move(item));
  }
  return all;
}

namespace {

/// Whether a terminal shows this code point in two columns: approximately the East Asian scripts.
bool is_wide(char32_t c) {
  return (c >= 0x1100 && c <= 0x115F) || (c >= 0x2E80 && c <= 0xA4CF) ||
         (c >= 0xAC00 && c <= 0xD7A3) || (c >= 0xF900 && c <= 0xFAFF) ||
         (c >= 0xFF00 && c <= 0xFF60) || (c >= 0x20000 && c <= 0x3FFFD);
}

/// Blanks of the width of `text` on a terminal; tabs stay tabs.
std::string blanks_for(std::string_view text) {
  std::string blanks;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    char32_t c = length == 1 ? lead : lead & (0x7Fu >> length);
    for (std::size_t k = 1; k < length && i + k < text.size(); ++k) {
      c = (c << 6) | (static_cast<unsigned char>(text[i + k]) & 0x3Fu);
    }
    blanks += c == '\t' ? "\t" : is_wide(c) ? "  " : " ";
    i += length;
  }
  return blanks;
}

}  // namespace

std::string to_string(const Diagnostic& diagnostic) {
  const Place& place = diagnostic.place;
  std::string text = printable(place.source);
  if (place.line > 0) text += fmt::format(":{}:{}", place.line, place.column);
  if (!text.empty()) text += ": ";
  text += fmt::format("{}[{}]: {}", severity_name(diagnostic.severity), diagnostic.code,
                      printable(diagnostic.message));
  if (place.line > 0 && !diagnostic.excerpt.empty()) {
    const std::string_view before =
        std::string_view(diagnostic.excerpt).substr(0, diagnostic.caret);
    text += fmt::format("\n  {}\n  {}^", diagnostic.excerpt, blanks_for(before));
  }
  return text;
}

}  // namespace kinefile
