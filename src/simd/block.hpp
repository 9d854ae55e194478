// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace kinefile::simd {

/// How many frames the kernels work on at a time.
inline constexpr std::size_t kBlock = 16;

}  // namespace kinefile::simd
