// SPDX-License-Identifier: MIT
#include "document/check_names.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/printable.hpp"
#include "base/words.hpp"
#include "kinefile/body_motion.hpp"

namespace kinefile {
namespace {

std::vector<std::string> names_of(const Document& document) {
  std::vector<std::string> names;
  if (has_skeleton(document)) {
    for (const Joint& joint : skeleton_of(document).joints) names.push_back(joint.name);
  } else if (const BodyMotion* body = std::get_if<BodyMotion>(&document.content)) {
    for (const Component& component : body->components) {
      names.insert(names.end(), component.part_names.begin(), component.part_names.end());
    }
  }
  return names;
}

/// Whether a character is a control character or one that takes no room and has no meaning in a
/// name: marks of direction and of bytes' order, soft hyphens, spaces of no width. Joiners, which
/// some scripts need, are not.
bool is_unseen(char32_t c) {
  return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0xAD || c == 0x200B || c == 0x200E ||
         c == 0x200F || (c >= 0x202A && c <= 0x202E) || (c >= 0x2060 && c <= 0x2069) || c == 0xFEFF;
}

std::optional<std::uint32_t> unseen_character(std::string_view name) {
  while (!name.empty()) {
    const Character first = first_character(name);
    const bool is_byte = first.value == 0 && name[0] != '\0';  // no UTF-8
    if (!is_byte && is_unseen(first.value)) return first.value;
    name.remove_prefix(first.length);
  }
  return std::nullopt;
}

}  // namespace

void check_names(const Document& document, Diagnostics& diagnostics) {
  std::map<std::string, std::string> spelling_of;  // by the name in lower case
  for (const std::string& name : names_of(document)) {
    if (const auto character = unseen_character(name)) {
      diagnostics.add(Severity::Warning, "DOC002",
                      fmt::format("the name '{}' has a character that cannot be seen, U+{:04X}",
                                  name, *character));
    }
    const auto [other, is_new] = spelling_of.try_emplace(lowered(name), name);
    if (is_new || other->second == name) continue;
    diagnostics.add(Severity::Note, "DOC003",
                    fmt::format("the names '{}' and '{}' differ in case alone; options that name "
                                "one may mean both",
                                other->second, name));
  }
}

}  // namespace kinefile
