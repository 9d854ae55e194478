// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace kinefile::simd {

/// How many frames the kernels work on at a time.
inline constexpr std::size_t kBlock = 16;

/// Vectors of `kSize` numbers, one array per component: [component][vector]. The length of the
/// arrays is a multiple of kBlock (see `padded`); the padding is unspecified.
template <std::size_t kSize>
using Components = std::array<std::vector<double>, kSize>;

using Angles = Components<3>;
using Quaternions = Components<4>;  ///< w x y z

/// The next multiple of kBlock.
constexpr std::size_t padded(std::size_t count) { return (count + kBlock - 1) / kBlock * kBlock; }

}  // namespace kinefile::simd
