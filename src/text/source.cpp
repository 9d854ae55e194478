// SPDX-License-Identifier: MIT
#include "text/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "base/printable.hpp"
#include "text/numbers.hpp"

namespace kinefile::text {
namespace {

constexpr std::size_t kExcerptBytes = 100;

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// Adds the starts of lines to the known ones, until one is beyond an offset; after the last line
/// comes one beyond all offsets. So a message about the start of a file is cheap.
void find_line_starts(std::string_view text, std::size_t offset, std::vector<std::size_t>& starts) {
  if (starts.empty()) starts.push_back(0);
  while (starts.back() <= offset) {
    const char* end = std::find_if(text.data() + starts.back(), text.data() + text.size(),
                                   [](char c) { return is_line_end(c); });
    const auto at = static_cast<std::size_t>(end - text.data());
    const bool is_crlf = text.substr(at).starts_with("\r\n");
    starts.push_back(at == text.size() ? at + 1 : at + (is_crlf ? 2 : 1));
  }
}

/// Shows a line, or the part of a long line around a column, cut between characters. Reads only
/// that part, because a line may be as long as the file.
void cut_excerpt(std::string_view from_line_start, std::size_t column, Diagnostic& diagnostic) {
  std::size_t begin = column > kExcerptBytes / 2 ? column - kExcerptBytes / 2 : 0;
  const std::string_view ahead = from_line_start.substr(column, kExcerptBytes + 1);
  const std::size_t line_end = ahead.find_first_of("\r\n");
  const bool is_line_end_near = line_end != std::string_view::npos || ahead.size() <= kExcerptBytes;
  std::size_t end = column + std::min(line_end, ahead.size());
  if (end <= kExcerptBytes) begin = 0;
  const bool is_cut = end - begin > kExcerptBytes || !is_line_end_near;
  if (is_cut) end = std::min(end, begin + kExcerptBytes);
  while (begin < end && is_continuation(from_line_start[begin])) ++begin;
  while (is_cut && end > begin && is_continuation(from_line_start[end])) --end;
  diagnostic.excerpt = begin > 0 ? "..." : "";
  diagnostic.caret = diagnostic.excerpt.size() + column - begin;
  // A place holder for each byte: the caret counts bytes.
  for (std::string_view rest = from_line_start.substr(begin, end - begin); !rest.empty();) {
    const Character first = first_character(rest);
    const bool is_shown = first.is_printable || rest[0] == '\t';
    diagnostic.excerpt +=
        is_shown ? std::string(rest.substr(0, first.length)) : std::string(first.length, '?');
    rest.remove_prefix(first.length);
  }
  if (is_cut) diagnostic.excerpt += "...";
}

}  // namespace

std::size_t Source::line_index(std::size_t offset) const {
  find_line_starts(text_, offset, line_starts_);
  const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  return static_cast<std::size_t>(after - line_starts_.begin()) - 1;
}

Place Source::place_of(const char* position) const {
  assert(position >= text_.data() && position <= end());
  const auto offset = static_cast<std::size_t>(position - text_.data());
  const std::size_t line = line_index(offset);
  return {name_, line + 1, offset - line_starts_[line] + 1};
}

Diagnostic Source::diagnose(Severity severity, std::string code, std::string message,
                            const char* position) const {
  Diagnostic diagnostic{severity, {}, std::move(code), std::move(message), place_of(position),
                        {},       0};
  const std::size_t start = line_starts_[diagnostic.place.line - 1];
  cut_excerpt(text_.substr(start), diagnostic.place.column - 1, diagnostic);
  return diagnostic;
}

void report(const Source& source, Diagnostics& diagnostics, Severity severity, std::string code,
            std::string message, const char* position) {
  if (diagnostics.is_full(code, severity)) {
    diagnostics.add(severity, std::move(code), {});
  } else {
    diagnostics.add(source.diagnose(severity, std::move(code), std::move(message), position));
  }
}

std::string_view line_end_of(std::string_view text) {
  const std::size_t end = text.find_first_of("\r\n");
  if (end == std::string_view::npos || text[end] == '\n') return "lf";
  return end + 1 < text.size() && text[end + 1] == '\n' ? "crlf" : "cr";
}

std::string quoted(std::string_view token) {
  if (token.empty()) return "the end of the file";
  constexpr std::size_t kLongest = 40;
  std::string shown = "'";
  std::size_t length = std::min(token.size(), kLongest);
  while (length < token.size() && length > 0 && is_continuation(token[length])) --length;
  shown += printable(token.substr(0, length));
  return shown + (length < token.size() ? "...'" : "'");
}

}  // namespace kinefile::text
