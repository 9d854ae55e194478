// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "text/yaml/tree.hpp"

namespace kinefile::text::yaml {

/// A key and its value as YAML lines, without indentation and the last line's end: mappings and
/// lists in block style, lists of scalars in flow style. Scalars keep their spelling, aliases and
/// merges are written out, comments are not known.
std::string entry_text(const Node& key, const Node& value);

/// A value as YAML lines, as `entry_text` has it.
std::string block_text(const Node& node);

/// A value as JSON on one line. What JSON has no word for becomes a string.
std::string json_text(const Node& node);

/// A key as a JSON string: of a list or mapping, what stands for it in flow style.
std::string json_key(const Node& key);

/// Lines, each with so many blanks before it.
std::string indented(std::string_view lines, std::size_t num_blanks);

}  // namespace kinefile::text::yaml
