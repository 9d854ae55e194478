// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace kinefile::test {

/// How to list events.
struct YamlEventOptions {
  bool takes_rows = false;   ///< whether rows of numbers are taken as a whole
  bool has_numbers = false;  ///< plain scalars that are numbers are listed as such, without places
};

/// The events of a YAML text by our parser, a line each; nothing if it is no YAML.
/// \param is_refused  set if the text is refused for a reason that libyaml does not have
std::optional<std::string> yaml_events(std::string_view text, YamlEventOptions options,
                                       bool* is_refused = nullptr);

/// The events of a YAML text by libyaml, in the same words.
std::optional<std::string> libyaml_events(std::string_view text);

}  // namespace kinefile::test
