// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

namespace kinefile::text {

/// The character of two bytes in code page 932, if there is one.
std::optional<char32_t> cp932_character(std::uint8_t lead, std::uint8_t trail);

/// The bytes of a character in code page 932, the first one in the high byte; a single-byte
/// character has no lead byte. If a character occurs several times there, the code that Windows
/// writes.
std::optional<std::uint16_t> cp932_code(char32_t character);

}  // namespace kinefile::text
