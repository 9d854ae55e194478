// SPDX-License-Identifier: MIT
#pragma once

#pragma GCC visibility push(default)

namespace kinefile {

/// The version of the library, "major.minor.patch" (https://semver.org).
inline constexpr char kVersion[] = "0.1.0";

}  // namespace kinefile

#pragma GCC visibility pop
