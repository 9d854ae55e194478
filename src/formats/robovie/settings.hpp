// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kinefile::robovie {

/// The content of one pair of brackets.
struct Field {
  std::string_view text;     ///< without the brackets
  const char* at = nullptr;  ///< the opening bracket
  bool is_doubled = false;   ///< [[...]], as for texts
};

/// A line `KEY:[field]-[field]-[[field]]`, split. All views point into the line.
struct Setting {
  std::string_view key;  ///< without the colon
  const char* at = nullptr;
  std::vector<Field> fields;
  const char* end = nullptr;           ///< its end, without blanks
  const char* first_blank = nullptr;   ///< a blank that the editor does not write; null if none
  const char* fault = nullptr;         ///< where it does not have this form; null if it does
  std::string_view expected_at_fault;  ///< "':'", for a message
};

/// Splits a line, up to the first fault. A doubled bracket ends at the first `]]` that is followed
/// by `-[` or by the end of the line, because texts may contain brackets.
/// \param setting  receives the result; its memory is reused
void split_setting(std::string_view line, Setting& setting);

/// A text line by line. LF, CRLF and a lone CR end a line.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}
  /// Consumes the next line, without its end; false after the last one.
  bool next(std::string_view& line);

 private:
  std::string_view rest_;
};

/// A text without half-width blanks at both ends.
std::string_view trimmed(std::string_view text);

/// The value of numbers with more than nine digits.
inline constexpr int kLargestNumber = 999'999'999;

/// A whole number in decimal digits, with a sign or without; blanks around it are skipped.
std::optional<int> parse_integer(std::string_view text);

/// The ASCII character that a full-width character looks like; 0 if there is none.
/// \param length  out: the number of its bytes
char narrow_form(std::string_view text, std::size_t& length);

/// The place of the first full-width character in a text that looks like an ASCII one, or npos.
std::size_t find_full_width(std::string_view text);

/// A token for a message: quoted, or "the end of the line".
std::string shown(std::string_view token);

}  // namespace kinefile::robovie
