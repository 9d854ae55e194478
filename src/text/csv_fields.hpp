// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kinefile::text {

/// A field of a table: its text without quotes, and where it starts.
struct CsvField {
  std::string text;
  const char* at = nullptr;
};

/// Reads a table field by field, as in RFC 4180. Lines end with LF, CRLF or CR.
class CsvFields {
 public:
  explicit CsvFields(std::string_view text) : next_(text.data()), end_(next_ + text.size()) {}

  bool is_at_end() const { return next_ == end_; }
  const char* position() const { return next_; }
  /// \param position  where a field or a line begins, or the end of the text
  void move_to(const char* position) { next_ = position; }

  /// Consumes the fields of one record, which may contain line ends in quotes.
  std::vector<CsvField> take_record();
  /// Consumes one field, but not its separator.
  CsvField take_field();
  /// Consumes a field without quotes: its text without blanks around it, not copied. Empty, and
  /// nothing is consumed, if there are quotes.
  std::optional<std::string_view> take_plain();
  /// The place of a fault with quotes: a quote that is never closed, or text after a closed one;
  /// null if there is no fault so far.
  const char* fault() const { return fault_; }

  /// Consumes a comma if one follows.
  bool take_comma();
  /// Consumes a line end if one follows; true at the end of the text, too.
  bool take_line_end();

 private:
  void take_quoted(std::string& text);

  const char* next_;
  const char* end_;
  const char* fault_ = nullptr;
};

}  // namespace kinefile::text
