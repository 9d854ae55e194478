// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "kinefile/diagnostics.hpp"
#include "kinefile/result.hpp"

namespace kinefile::text {

/// A text as UTF-8: a view into the bytes if they were UTF-8 already, otherwise into `storage`.
struct DecodedText {
  std::string storage;
  std::string_view passed_through;
  std::string encoding;  ///< what the bytes were: "utf-8", "utf-16le", "utf-16be", "latin-1", ...
  bool has_bom = false;

  std::string_view view() const { return storage.empty() ? passed_through : storage; }
  /// The encoding as text: "utf-8 with BOM".
  std::string description() const { return encoding + (has_bom ? " with BOM" : ""); }
};

/// The byte at `i`, or 0 after the end.
inline std::uint8_t byte_at(std::string_view bytes, std::size_t i) {
  return i < bytes.size() ? static_cast<std::uint8_t>(bytes[i]) : 0;
}

/// Adds a character as UTF-8.
void append_utf8(std::string& out, char32_t c);

/// Decodes bytes to UTF-8 without a byte order mark. Bytes that the encoding does not have become
/// U+FFFD, with a warning TXT001; Latin-1 that was not requested is a note TXT002.
/// \param encoding  "utf-8", "utf-16le", "utf-16be", "latin-1" or "cp932"; empty: detected by a
/// byte order mark, otherwise by zero bytes as UTF-16, otherwise by validity as UTF-8, otherwise
/// `fallback`
/// \param fallback  the encoding if detection fails; in Latin-1 every byte is a character
/// \errors TXT003 if the encoding is not known
Result<DecodedText> decode(std::string_view bytes, const std::string& encoding,
                           const std::string& source_name, Diagnostics& diagnostics,
                           std::string_view fallback = "latin-1");

}  // namespace kinefile::text
