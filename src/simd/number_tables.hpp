// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace kinefile::simd {

inline constexpr std::size_t kToken = 16;      ///< bytes of a token that is read with others
inline constexpr std::size_t kLongToken = 32;  ///< bytes of a token that is read alone
inline constexpr std::size_t kNoPoint = 16;    ///< the place of a point that is not there

/// A row of 16 bytes for each length: 0xFF for the bytes of a token that ends with the block.
struct LengthMasks {
  std::array<std::uint8_t, 3 * kToken> bytes{};
  constexpr LengthMasks() {
    for (std::size_t i = kToken; i < bytes.size(); ++i) bytes[i] = 0xFF;
  }
  constexpr const std::uint8_t* of(std::size_t length) const { return &bytes[length]; }
};
inline constexpr LengthMasks kLengthMasks;

/// For each place of the point, where the bytes of a block come from so that the point is gone. A
/// point behind all digits stays, which makes the token fail.
struct PointShuffles {
  alignas(16) std::array<std::array<std::uint8_t, 16>, kNoPoint + 1> bytes{};
  constexpr PointShuffles() {
    for (std::size_t point = 0; point <= kNoPoint; ++point) {
      const bool is_taken_out = point < kToken - 1;
      for (std::size_t i = 0; i < 16; ++i) {
        const bool is_moved = is_taken_out && i <= point;
        bytes[point][i] = static_cast<std::uint8_t>(!is_moved ? i : i == 0 ? 0x80 : i - 1);
      }
    }
  }
};
inline constexpr PointShuffles kPointShuffles;

/// The power of ten below a token whose point is at a place.
struct Divisors {
  std::array<double, kNoPoint + 1> values{};
  constexpr Divisors() {
    double power = 1;
    for (std::size_t point = kToken; point-- > 0; power *= 10) values[point] = power;
    values[kNoPoint] = 1;
  }
};
inline constexpr Divisors kDivisors;

/// Masks of 32 bytes.
struct LongMasks {
  std::array<std::uint8_t, 4 * kLongToken> bytes{};  ///< none, all, all, none
  constexpr LongMasks() {
    for (std::size_t i = kLongToken; i < 3 * kLongToken; ++i) bytes[i] = 0xFF;
  }
  /// 0xFF for the first bytes, or the last ones.
  constexpr const std::uint8_t* first(std::size_t count) const {
    return &bytes[3 * kLongToken - count];
  }
  constexpr const std::uint8_t* last(std::size_t count) const { return &bytes[count]; }
};
inline constexpr LongMasks kLongMasks;

/// As `Divisors`, for tokens of 32 bytes. Powers that no double is equal to are not a number.
struct LongDivisors {
  std::array<double, kLongToken + 1> values{};
  constexpr LongDivisors() {
    constexpr std::size_t kMostDecimals = 22;
    double power = 1;
    for (std::size_t decimals = 0; decimals < kLongToken; ++decimals, power *= 10) {
      values[kLongToken - 1 - decimals] =
          decimals <= kMostDecimals ? power : std::numeric_limits<double>::quiet_NaN();
    }
    values[kLongToken] = 1;
  }
};
inline constexpr LongDivisors kLongDivisors;

/// The sign bits of four tokens, of which those whose bit is set are negative.
struct SignBits {
  alignas(32) std::array<std::array<std::uint64_t, 4>, 16> values{};
  constexpr SignBits() {
    for (std::size_t signs = 0; signs < 16; ++signs) {
      for (std::size_t i = 0; i < 4; ++i)
        values[signs][i] = static_cast<std::uint64_t>(signs >> i & 1) << 63;
    }
  }
};
inline constexpr SignBits kSignBits;

/// Where the points of all tokens of a group are expected: numbers by "%.6f" have six decimals.
struct ForeseenPoint {
  std::size_t place = kNoPoint;
  std::uint64_t bits = 0;  ///< of a group; a bit for each byte
  int trust = kMostTrust;  ///< above 0 as long as few groups were others

  static constexpr int kMostTrust = 64;
  static constexpr int kMiss = 16;

  void is_met() { trust = std::min(trust + 1, kMostTrust); }
  void is_missed(std::size_t found, std::size_t num_tokens) {
    trust = std::max(trust - kMiss, 0);
    place = found;
    bits = 0;
    for (std::size_t i = 0; found < kNoPoint && i < num_tokens; ++i) {
      bits |= std::uint64_t{1} << (16 * i + found);
    }
  }
};

/// The largest digits of a token of 15 digits in a block, and of one of 19 in the first of two.
alignas(16) inline constexpr std::uint8_t kShortLimits[16] = {0, 9, 9, 9, 9, 9, 9, 9,
                                                              9, 9, 9, 9, 9, 9, 9, 9};
alignas(16) inline constexpr std::uint8_t kLongLimits[16] = {0, 0, 0, 0, 0, 0, 0, 0,
                                                             0, 0, 0, 0, 0, 9, 9, 9};
alignas(32) inline constexpr std::uint8_t kLongGroupLimits[32] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9};
alignas(16) inline constexpr std::uint8_t kPlaces[16] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                         8, 9, 10, 11, 12, 13, 14, 15};

}  // namespace kinefile::simd
