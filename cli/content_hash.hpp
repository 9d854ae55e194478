// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "kinefile/format.hpp"

namespace kinefile::cli {

/// A number that differs if bytes differ, but for chance: it finds changes, not forgeries. It is
/// the same on every machine of one byte order.
std::uint64_t content_hash(std::string_view bytes);

/// The same for bytes that are read piece by piece; empty if that fails.
std::optional<std::uint64_t> content_hash(const ByteSource& bytes);

}  // namespace kinefile::cli
