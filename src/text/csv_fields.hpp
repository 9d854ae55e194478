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

/// Goes over a table, field by field, as RFC 4180 has it. Lines end with LF, CRLF or CR.
class CsvFields {
 public:
  explicit CsvFields(std::string_view text) : next_(text.data()), end_(next_ + text.size()) {}

  bool is_at_end() const { return next_ == end_; }
  const char* position() const { return next_; }

  /// Takes the fields of one record, which may hold line ends in quotes.
  std::vector<CsvField> take_record();
  /// Takes one field and leaves what separates it.
  CsvField take_field();
  /// The text of a field without quotes and without blanks around it, without a copy; null where
  /// there are quotes.
  std::optional<std::string_view> take_plain();
  /// Where quotes are not as they should be: one that is never closed, or what follows a closed
  /// one; null if there is nothing of the kind so far.
  const char* fault() const { return fault_; }

  /// Takes a comma if one follows.
  bool take_comma();
  /// Takes a line end if one follows; true at the end of the text, too.
  bool take_line_end();

 private:
  void take_quoted(std::string& text);

  const char* next_;
  const char* end_;
  const char* fault_ = nullptr;
};

}  // namespace kinefile::text
