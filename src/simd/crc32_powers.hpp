// SPDX-License-Identifier: MIT
// Polynomials modulo that of CRC-32, reflected: the highest bit of a number is the coefficient of
// x^0.
#pragma once

#include <cstdint>

namespace kinefile::simd {

/// A remainder times x.
constexpr std::uint32_t times_x(std::uint32_t remainder) {
  constexpr std::uint32_t kPolynomial = 0xEDB88320;
  return (remainder >> 1) ^ ((remainder & 1) != 0 ? kPolynomial : 0);
}

/// x^exponent as a factor for carry-less products of reflected numbers, whose results are one bit
/// too low.
constexpr std::uint64_t crc32_power(unsigned exponent) {
  std::uint32_t remainder = 0x80000000;
  for (unsigned i = 0; i < exponent; ++i) remainder = times_x(remainder);
  return std::uint64_t{remainder} << 1;
}

// The constants of the paper.
static_assert(crc32_power(4 * 128 + 32) == 0x154442bd4);
static_assert(crc32_power(4 * 128 - 32) == 0x1c6e41596);
static_assert(crc32_power(128 + 32) == 0x1751997d0);
static_assert(crc32_power(128 - 32) == 0x0ccaa009e);

}  // namespace kinefile::simd
