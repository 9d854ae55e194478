// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kinefile::robovie {

/// What one pair of brackets holds.
struct Field {
  std::string_view text;     ///< without the brackets
  const char* at = nullptr;  ///< the opening bracket
  bool is_doubled = false;   ///< [[...]], as texts stand
};

/// A line `KEY:[field]-[field]-[[field]]`, split. All views lead into the line.
struct Setting {
  std::string_view key;  ///< without the colon
  const char* at = nullptr;
  std::vector<Field> fields;
  const char* end = nullptr;           ///< where it ends, without blanks
  const char* first_blank = nullptr;   ///< a blank that the editor does not write; else null
  const char* fault = nullptr;         ///< where it is not laid out like this; else null
  std::string_view expected_at_fault;  ///< "':'", for a message
};

/// Splits a line; up to a fault, if there is one. A doubled bracket ends at the first `]]` that is
/// followed by `-[` or by the end of the line, since texts may hold brackets.
/// \param setting  takes the result; its memory is used again
void split_setting(std::string_view line, Setting& setting);

/// A text line by line. LF, CRLF and a lone CR end a line.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}
  /// Takes the next line, without its end; false after the last one.
  bool next(std::string_view& line);

 private:
  std::string_view rest_;
};

/// A text without blanks at both ends, those of half width.
std::string_view trimmed(std::string_view text);

/// What numbers beyond nine digits become.
inline constexpr int kLargestNumber = 999'999'999;

/// A whole number in decimal digits, with a sign or without; blanks around it are passed over.
std::optional<int> parse_integer(std::string_view text);

/// The character of ASCII that a full-width one looks like; empty if it does not. \param length
/// takes how many bytes that has
char narrow_form(std::string_view text, std::size_t& length);

/// Where the first full-width character that looks like one of ASCII stands in a text, or npos.
std::size_t find_full_width(std::string_view text);

/// A token for a message: quoted, or "the end of the line".
std::string shown(std::string_view token);

}  // namespace kinefile::robovie
