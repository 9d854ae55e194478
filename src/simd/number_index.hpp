// SPDX-License-Identifier: MIT
#pragma once

#include <fast_float/fast_float.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

/// Whether the instruction set that is compiled has mask registers. Readers of rows then call their
/// AVX2 code: their blocks have 32 bytes at the most, and masks in vectors are faster for them than
/// the mask registers of AVX-512 (measured: by a tenth).
#define KINEFILE_HAS_WIDE_MASKS (HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL)

namespace kinefile::simd {

inline constexpr std::size_t kWord = 64;          ///< bytes that a mask stands for
inline constexpr std::size_t kPiece = 32 * 1024;  ///< bytes that are indexed at a time

/// How far ahead memory is asked for: it takes as long as reading some hundred bytes. The
/// processor's own guess ends with each page.
inline constexpr std::size_t kPrefetch = 1024;

/// The first rows of a piece and their tokens, as distances from the piece's beginning. A token has
/// a separator behind it, and a row a token.
struct Index {
  std::size_t num_tokens = 0;
  std::size_t num_rows = 0;
  std::array<std::uint32_t, kPiece / 2 + kWord> ends;      ///< of tokens
  std::array<std::uint32_t, kPiece / 2 + kWord> begins;    ///< of tokens
  std::array<std::uint32_t, kPiece / 2 + kWord> row_ends;  ///< behind LF
};

/// Reads a token that the kernels leave; whether it is a finite number.
inline bool read_odd_token(const char* begin, const char* end, double& value) {
  if (*begin == '+' && end - begin > 1 && begin[1] != '-') ++begin;
  const auto [next, error] = fast_float::from_chars(begin, end, value);
  return error == std::errc() && next == end && std::isfinite(value);
}

}  // namespace kinefile::simd
