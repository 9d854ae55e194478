// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace kinefile::shape {

/// The ending of the names of helper bones, which only a skeleton of bones needs.
inline constexpr std::string_view kHelperSuffix = "_kf_helper";

/// The ending of the name of the helper bone that keeps the name of the root.
inline constexpr std::string_view kRootHelperSuffix = "_root_kf_helper";

}  // namespace kinefile::shape
