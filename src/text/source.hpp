// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/diagnostics.hpp"

namespace kinefile::text {

/// A text and its name. A token is a view into the text, so its line and column are computed only
/// for a message.
class Source {
 public:
  /// \param text  UTF-8, must outlive this
  Source(std::string name, std::string_view text) : name_(std::move(name)), text_(text) {}

  std::string_view text() const { return text_; }
  const std::string& name() const { return name_; }
  const char* end() const { return text_.data() + text_.size(); }

  /// The place of a pointer into the text. LF, CRLF and a lone CR end a line.
  Place place_of(const char* position) const;

  /// A diagnostic about a place in the text, with the line and a caret.
  Diagnostic diagnose(Severity severity, std::string code, std::string message,
                      const char* position) const;

 private:
  /// The start of the line that holds this offset, as an index into line_starts_.
  std::size_t line_index(std::size_t offset) const;

  std::string name_;
  std::string_view text_;
  mutable std::vector<std::size_t> line_starts_;  ///< as far as needed so far
};

/// Adds a diagnostic about a place; only counts it if there are too many of its kind.
void report(const Source& source, Diagnostics& diagnostics, Severity severity, std::string code,
            std::string message, const char* position);

/// The line end that a text uses, by its first line: "lf", "crlf" or "cr".
std::string_view line_end_of(std::string_view text);

/// A token in the form for a message: quoted, control characters escaped, long tokens cut; an empty
/// one is "the end of the file".
std::string quoted(std::string_view token);

}  // namespace kinefile::text
