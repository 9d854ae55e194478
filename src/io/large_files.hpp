// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "kinefile/io.hpp"

namespace kinefile {

/// How many bytes of a file are used to detect its format.
inline constexpr std::size_t kHeadBytes = std::size_t{1} << 16;

/// Reads a large and plain file without holding its bytes; empty for any other, which has to be
/// read whole.
std::optional<Result<Document>> read_large_file(const std::string& path, const Format* format,
                                                ReadOptions options, Diagnostics& diagnostics);

}  // namespace kinefile
