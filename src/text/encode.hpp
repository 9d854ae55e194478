// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace kinefile::text {

/// Whether `append_encoded` knows an encoding: those that `decode` knows.
bool is_encoding(std::string_view encoding);

/// The byte order mark of an encoding; empty for those that have none.
std::string_view byte_order_mark(std::string_view encoding);

/// Appends a text in an encoding, up to the first character that the encoding does not have.
/// \param text      UTF-8
/// \param encoding  "utf-8", "utf-16le", "utf-16be", "latin-1" or "cp932"
/// \returns         that character; empty if all of the text was appended
std::string_view append_encoded(std::string& out, std::string_view text, std::string_view encoding);

}  // namespace kinefile::text
