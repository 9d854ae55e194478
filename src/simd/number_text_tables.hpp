// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace kinefile::simd {

inline constexpr std::size_t kTextBytes = 16;  ///< digits and point of a number, without its sign
inline constexpr int kMostDecimals = 14;       ///< with a digit before the point and the point

/// Powers of ten that are exact, by decimals; behind them one that makes every number fail.
struct TenPowers {
  std::array<double, kMostDecimals + 2> values{};
  constexpr TenPowers() {
    double power = 1;
    for (std::size_t d = 0; d <= kMostDecimals; ++d, power *= 10) values[d] = power;
    values[kMostDecimals + 1] = std::numeric_limits<double>::quiet_NaN();
  }
};
inline constexpr TenPowers kTenPowers;

/// For each exponent of a double, as its bits are, the most decimals that leave fewer than 16
/// digits. One more than kMostDecimals: numbers that may be printed with an exponent.
struct DecimalsOfExponent {
  std::array<std::uint8_t, 2048> values{};
  constexpr DecimalsOfExponent() {
    values.fill(kMostDecimals + 1);
    values[0] = kMostDecimals;  // zeros; others of this exponent are no multiples of 1e-14
    constexpr std::size_t kLeast = 1023 - 13;  // 2^-13 is the least power above 1e-4
    double limit = 1.0 / 4096;                 // of numbers of an exponent
    for (std::size_t exponent = kLeast; limit < 1e15; ++exponent, limit *= 2) {
      std::size_t d = kMostDecimals;
      while (limit * kTenPowers.values[d] >= 1e15) --d;
      values[exponent] = static_cast<std::uint8_t>(d);
    }
  }
};
inline constexpr DecimalsOfExponent kDecimalsOfExponent;

/// For each number of decimals and each place of the first digit among 16, where the bytes of the
/// text come from; the point is in byte 0.
struct TextShuffles {
  using OfDecimals = std::array<std::array<std::uint8_t, kTextBytes>, kTextBytes>;
  alignas(16) std::array<OfDecimals, kMostDecimals + 2> bytes{};
  constexpr TextShuffles() {
    for (std::size_t d = 0; d <= kMostDecimals; ++d) {
      for (std::size_t first = 1; first < kTextBytes - d; ++first) {
        const std::size_t point = d == 0 ? kTextBytes : kTextBytes - d - first;
        for (std::size_t i = 0; i < kTextBytes; ++i) {
          const std::size_t from = i < point ? first + i : i == point ? 0 : first + i - 1;
          bytes[d][first][i] = static_cast<std::uint8_t>(std::min(from, kTextBytes - 1));
        }
      }
    }
  }
};
inline constexpr TextShuffles kTextShuffles;

}  // namespace kinefile::simd
