// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string_view>

namespace kinefile::text::yaml {

/// Visits the entries of the mapping at the top of a text, in their order, until `visit` returns
/// false. A text that is cut off, or has a fault, has those before it. For the formats' probes,
/// which see only the first part of a file.
/// \param visit  gets a key and its value; either is empty if it is not a scalar
void visit_top_entries(
    std::string_view text,
    const std::function<bool(std::string_view key, std::string_view value)>& visit);

}  // namespace kinefile::text::yaml
