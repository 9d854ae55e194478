// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <string_view>

#include "checks.hpp"

namespace kinefile::fuzz {

/// These bytes as a file that is read piece by piece. They must outlive the result.
inline ByteSource source_of(std::string_view bytes) {
  ByteSource source;
  source.size = bytes.size();
  source.read = [bytes](std::size_t offset, std::span<char> out) {
    require(offset + out.size() <= bytes.size());
    std::copy_n(bytes.data() + offset, out.size(), out.data());
    return true;
  };
  return source;
}

inline void check_messages(const Diagnostics& found, const Diagnostics& of_whole) {
  require(found.items().size() == of_whole.items().size());
  for (std::size_t i = 0; i < found.items().size(); ++i) {
    require(to_string(found.items()[i]) == to_string(of_whole.items()[i]));
  }
}

inline void check_same_content(const Document& found, const Document& whole) {
  require(found.content.index() == whole.content.index());
  if (const Motion* a = std::get_if<Motion>(&found.content)) {
    const Motion& b = std::get<Motion>(whole.content);
    require(a->clip.num_frames == b.clip.num_frames && same_values(a->clip.values, b.clip.values));
  }
  if (const BodyMotion* a = std::get_if<BodyMotion>(&found.content)) {
    const BodyMotion& b = std::get<BodyMotion>(whole.content);
    require(a->components.size() == b.components.size());
    for (std::size_t i = 0; i < a->components.size(); ++i) {
      const Component& one = a->components[i];
      const Component& other = b.components[i];
      require(one.num_frames == other.num_frames && same_values(one.values, other.values));
    }
  }
}

/// What is read by pieces is what is read whole, with the same messages.
inline void check_pieces(std::string_view format, std::string_view bytes,
                         const ReadOptions& options, const Result<Document>& whole,
                         const Diagnostics& of_whole) {
  Diagnostics diagnostics;
  const auto pieces = find_format(format)->read_pieces(source_of(bytes), options, diagnostics);
  if (!pieces) return;
  require(pieces->has_value() && whole.has_value());
  check_messages(diagnostics, of_whole);
  check_same_content(**pieces, *whole);
}

}  // namespace kinefile::fuzz
