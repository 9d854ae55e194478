// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace kinefile {

/// The name of a part of a component in a table where the part has no name of its own and the
/// component is neither joints nor links: "JointVelocity3" of what robots' programs usually record,
/// "Markers[3]" of any other content, which a name with digits alone would not show.
std::string numbered_part(std::string_view content, std::size_t part);

/// The content of a part that `numbered_part` named; nothing for any other name.
std::optional<std::string> content_of_numbered_part(std::string_view name);

}  // namespace kinefile
