// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace kinefile::shape {

/// How the names of helper bones end: bones that a skeleton of bones needs and others do not.
inline constexpr std::string_view kHelperSuffix = "_kf_helper";

/// How the name of the helper bone ends that keeps the name of the root.
inline constexpr std::string_view kRootHelperSuffix = "_root_kf_helper";

}  // namespace kinefile::shape
