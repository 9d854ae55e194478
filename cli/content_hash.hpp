// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace kinefile::cli {

/// A number that differs if bytes differ, but for chance: it finds changes, not forgeries. It is
/// the same on every machine of one byte order.
std::uint64_t content_hash(std::string_view bytes);

}  // namespace kinefile::cli
