// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kinefile {

/// A text with its ASCII letters in lower case.
std::string lowered(std::string_view text);

/// A list of names for a message, quoted, the first five and how many more there are.
std::string listed(const std::vector<std::string>& names);

}  // namespace kinefile
