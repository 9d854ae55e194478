// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace kinefile::text::yaml {

enum class ScalarStyle { Plain, SingleQuoted, DoubleQuoted, Literal, Folded };

enum class TokenKind {
  StreamEnd,
  VersionDirective,
  TagDirective,
  DocumentStart,
  DocumentEnd,
  BlockSequenceStart,
  BlockMappingStart,
  BlockEnd,
  FlowSequenceStart,
  FlowSequenceEnd,
  FlowMappingStart,
  FlowMappingEnd,
  BlockEntry,
  FlowEntry,
  Key,
  Value,
  Alias,
  Anchor,
  Tag,
  Scalar,
  Row,  ///< flow sequences of plain numbers as a whole, one or several
};

/// A token of YAML's grammar (YAML 1.1, chapters 4 and 5).
struct Token {
  TokenKind kind = TokenKind::StreamEnd;
  const char* at = nullptr;  ///< where it starts in the text
  std::string_view value;    ///< of a scalar; name of an anchor or alias; handle of a tag
  std::string_view suffix;   ///< of a tag; prefix of a tag directive
  ScalarStyle style = ScalarStyle::Plain;
  std::size_t row = 0;       ///< of a row: its shape, see NumberRows
  std::size_t num_rows = 1;  ///< of that shape, in consecutive entries of a sequence
};

}  // namespace kinefile::text::yaml
