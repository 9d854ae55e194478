// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "text/yaml/tree.hpp"

namespace kinefile::text::yaml {

/// A key and its value as YAML lines, without indentation and the last line's end: mappings and
/// lists in block style, lists of scalars in flow style. Scalars keep their spelling, aliases and
/// merges are written out, comments are dropped.
std::string entry_text(const Node& key, const Node& value);

/// A value as YAML lines, as in `entry_text`.
std::string block_text(const Node& node);

/// A value as JSON on one line. Values that JSON cannot express become strings.
std::string json_text(const Node& node);

/// A key as a JSON string; a list or mapping in flow style.
std::string json_key(const Node& key);

/// Lines, each indented by `num_blanks`.
std::string indented(std::string_view lines, std::size_t num_blanks);

}  // namespace kinefile::text::yaml
