// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "kinefile/pose_flow.hpp"

// The notation of slider words in formats of servo poses.
namespace kinefile {

/// A word as RobovieMaker writes it: 0x2b01 for an enabled slider, 0X2b01 for a disabled one.
inline std::string word_text(const SliderWord& word) {
  return fmt::format("0{}{:04x}", word.is_enabled ? 'x' : 'X',
                     static_cast<std::uint16_t>(word.value));
}

/// Reads 0x or 0X and four hexadecimal digits; empty for any other text.
inline std::optional<SliderWord> parse_word(std::string_view text) {
  if (text.size() != 6 || text[0] != '0' || (text[1] != 'x' && text[1] != 'X')) return std::nullopt;
  unsigned bits = 0;
  for (const char c : text.substr(2)) {
    const bool is_digit = c >= '0' && c <= '9';
    const char lower = static_cast<char>(c | 0x20);
    if (!is_digit && (lower < 'a' || lower > 'f')) return std::nullopt;
    bits = bits * 16 + static_cast<unsigned>(is_digit ? c - '0' : lower - 'a' + 10);
  }
  return SliderWord{static_cast<std::int16_t>(bits), text[1] == 'x'};
}

/// The mask of servos without power as 30 digits, the first for channel 0.
inline std::string servo_mask_text(const std::bitset<kNumServos>& servo_off) {
  std::string text(kNumServos, '0');
  for (std::size_t channel = 0; channel < kNumServos; ++channel) {
    if (servo_off[channel]) text[channel] = '1';
  }
  return text;
}

}  // namespace kinefile
