// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace kinefile::cli {

/// Bytes as base64 (RFC 4648), padded, in one line.
std::string base64_of(std::string_view bytes);

/// The bytes of padded base64; empty if the text is not valid.
std::optional<std::string> bytes_of_base64(std::string_view text);

}  // namespace kinefile::cli
