// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <string>

#include "kinefile/kinefile.hpp"

namespace kinefile::cli {

/// A word as a file has it: 0x2b01 of a slider that is enabled, 0X2b01 of one that is not.
inline std::string word_text(const SliderWord& word) {
  return fmt::format("0{}{:04x}", word.is_enabled ? 'x' : 'X',
                     static_cast<std::uint16_t>(word.value));
}

/// The mask of servos without power as a file has it: channel 0 first.
inline std::string mask_text(const std::bitset<kNumServos>& servo_off) {
  std::string text(kNumServos, '0');
  for (std::size_t channel = 0; channel < kNumServos; ++channel) {
    if (servo_off[channel]) text[channel] = '1';
  }
  return text;
}

}  // namespace kinefile::cli
