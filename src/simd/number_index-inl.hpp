// SPDX-License-Identifier: MIT
// Included once for every instruction set, so without an include guard.
//
// What readers of rows have in common: the places of tokens in a piece of text, and their numbers.

#include "simd/number_tokens-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {
namespace {

/// Appends the places of the bits of a mask. Writes up to 64 places in any case.
HWY_INLINE void append_places(std::uint64_t bits, std::uint32_t base, std::uint32_t* out) {
  const auto num = static_cast<std::size_t>(std::popcount(bits));
  const auto take = [&](std::size_t i) HWY_ATTR {
    out[i] = base + static_cast<std::uint32_t>(std::countr_zero(bits));
    bits &= bits - 1;
  };
  for (std::size_t i = 0; i < 8; ++i) take(i);
  if (num <= 8) return;
  for (std::size_t i = 8; i < 16; ++i) take(i);
  for (std::size_t i = 16; i < num; ++i) take(i);
}

/// Reads tokens of a piece one by one; returns the first that is no finite number, or the last.
/// \param num_before  bytes that can be read before the piece
HWY_INLINE std::size_t read_singly(const char* text, const Index& index, std::size_t first,
                                   std::size_t last, std::size_t num_before, double* out) {
  for (std::size_t i = first; i < last; ++i) {
    const bool has_room = num_before + index.ends[i] > kLongToken;
    if (has_room && read_single(reinterpret_cast<const std::uint8_t*>(text), index.begins[i],
                                index.ends[i], out[i])) {
      continue;
    }
    if (!read_odd_token(text + index.begins[i], text + index.ends[i], out[i])) return i;
  }
  return last;
}

/// Reads the tokens of a piece; returns the first that is no finite number, or the last.
/// \param num_before  bytes that can be read before the piece
HWY_INLINE std::size_t read_tokens(const char* text, const Index& index, std::size_t num_before,
                                   double* out) {
  const std::size_t count = index.num_tokens;
  ForeseenPoint foreseen;
  bool is_long = false;
  std::size_t i = 0;
  while (i < count && num_before + index.ends[i] <= kLongToken) ++i;
  if (const std::size_t read = read_singly(text, index, 0, i, num_before, out); read < i)
    return read;
  for (; i + kTokens <= count; i += kTokens) {
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(text);
    const std::uint32_t* const begins = &index.begins[i];
    const std::uint32_t* const ends = &index.ends[i];
    if (!is_long && read_group(bytes, begins, ends, foreseen, is_long, out + i)) continue;
    if (is_long && read_long_group(bytes, begins, ends, is_long, out + i)) continue;
    const std::size_t end = i + kTokens;
    if (const std::size_t read = read_singly(text, index, i, end, num_before, out); read < end) {
      return read;
    }
  }
  return read_singly(text, index, i, count, num_before, out);
}

/// Appends where the first rows of a piece begin, if that is wanted; returns the place behind them.
HWY_INLINE const char** append_begins(const char* text, const Index& index, std::size_t num_rows,
                                      const char** rows) {
  if (rows == nullptr) return nullptr;
  for (std::size_t i = 0; i < num_rows; ++i) {
    *rows++ = text + (i == 0 ? 0 : index.row_ends[i - 1]);
  }
  return rows;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace kinefile::simd
HWY_AFTER_NAMESPACE();
