// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

namespace kinefile::text {

/// The character of two bytes in code page 932, if there is one.
std::optional<char32_t> cp932_character(std::uint8_t lead, std::uint8_t trail);

/// The bytes of a character in code page 932, the first one above the other; one that has a single
/// byte has no lead. Of characters that stand there several times, the code that Windows writes.
std::optional<std::uint16_t> cp932_code(char32_t character);

}  // namespace kinefile::text
