// SPDX-License-Identifier: MIT
// Rows of numbers are read in pieces of some thousand bytes, each in two passes, so that no branch
// depends on what a single byte is:
// 1. Where tokens and lines end: 64 bytes at a time become a mask of separators, and masks a table
//    of token ends (Langdale and Lemire, "Parsing Gigabytes of JSON per Second", 2019).
// 2. Tokens become doubles, several at a time (number_tokens-inl.hpp). What is not plain is left to
//    fast_float, token by token, so that one odd token does not slow its neighbours.
// A byte that is no separator never separates.
// Highway compiles this file once for every instruction set and selects one at run time.

#include "simd/number_rows.hpp"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>

#ifdef __EMSCRIPTEN__
#define HWY_COMPILE_ONLY_EMU128  // WebAssembly has no vectors of doubles in Highway 1.0
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/number_rows.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/number_index.hpp"
#include "simd/number_tables.hpp"

#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128 && !KINEFILE_HAS_WIDE_MASKS
#include "simd/number_index-inl.hpp"
#endif

#if KINEFILE_HAS_WIDE_MASKS
namespace kinefile::simd::N_AVX2 {
NumberRows read_all(const char* begin, const char* end, std::size_t num_columns,
                    std::size_t max_rows, double* out, const char** rows, Separator separator);
}
#endif

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {
#if KINEFILE_HAS_WIDE_MASKS

NumberRows read_all(const char* begin, const char* end, std::size_t num_columns,
                    std::size_t max_rows, double* out, const char** rows, Separator separator) {
  return N_AVX2::read_all(begin, end, num_columns, max_rows, out, rows, separator);
}

#elif HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128

// Without vectors the other reader, which reads byte by byte, is as fast.
NumberRows read_all(const char* begin, const char*, std::size_t, std::size_t, double*, const char**,
                    Separator) {
  return {0, begin};
}

#else
namespace {

/// The bytes that separate tokens, each at the place that its low four bits say; elsewhere stands a
/// byte that belongs to another place.
using Separators = std::uint8_t[16];
alignas(16) constexpr Separators kBlanks = {' ', 0,    0,    0, 0, 0,    0, 0,
                                            0,   '\t', '\n', 0, 0, '\r', 0, 0};
alignas(16) constexpr Separators kCommas = {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, '\n', 0, ',', '\r', 0, 0};

struct WordMasks {
  std::uint64_t separators = 0;
  std::uint64_t line_ends = 0;
  std::uint64_t carriage_returns = 0;
};

HWY_INLINE WordMasks masks_of(const char* text, const Separators& listed) {
  const Bytes d;
  WordMasks masks;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(text);
  const auto table = hn::LoadDup128(d, listed);
  const auto low = hn::Set(d, 0x0F);
  for (std::size_t i = 0; i < kWord; i += hn::Lanes(d)) {
    const auto v = hn::LoadU(d, bytes + i);
    const auto is_separator = hn::And(v, low);
    masks.separators |= bits_of(d, hn::TableLookupBytes(table, is_separator) == v) << i;
    masks.line_ends |= bits_of(d, v == hn::Set(d, '\n')) << i;
    masks.carriage_returns |= bits_of(d, v == hn::Set(d, '\r')) << i;
  }
  return masks;
}

/// Adds the lines that end in a word, as long as each has the right number of tokens.
/// \param ends  of tokens in this word, which are not in the index yet
/// \returns     whether all of them have
HWY_INLINE bool append_lines(std::uint64_t line_ends, std::uint64_t ends, std::size_t at,
                             std::size_t num_columns, Index& index) {
  for (; line_ends != 0; line_ends &= line_ends - 1) {
    const std::uint64_t up_to = line_ends ^ (line_ends - 1);
    const auto num_in_word = static_cast<std::size_t>(std::popcount(ends & up_to));
    if (index.num_tokens + num_in_word != (index.num_rows + 1) * num_columns) return false;
    index.row_ends[index.num_rows++] =
        static_cast<std::uint32_t>(at) + static_cast<std::uint32_t>(std::popcount(up_to));
  }
  return true;
}

/// Finds where the tokens of the first rows of a piece begin.
/// \param begins  where separators end, by words
HWY_INLINE void find_begins(const std::uint64_t* begins, bool has_gaps, Index& index) {
  const std::size_t num_tokens = index.num_tokens;
  std::uint32_t* out = index.begins.data();
  if (has_gaps) {
    for (std::uint32_t at = 0; out < index.begins.data() + num_tokens; at += kWord) {
      append_places(*begins, at, out);
      out += std::popcount(*begins++);
    }
    return;
  }
  // With one separator between tokens, each begins one behind the end of the one before.
  out[0] = 0;
  for (std::size_t i = 0; i < num_tokens; ++i) out[i + 1] = index.ends[i] + 1;
}

/// Finds the first rows of a piece, and their tokens.
/// \param size  bytes, a multiple of kWord
template <Separator kSeparator>
HWY_INLINE void index_piece(const char* text, std::size_t size, std::size_t num_columns,
                            Index& index) {
  index.num_tokens = 0;
  index.num_rows = 0;
  std::uint64_t gaps = 0;
  std::uint64_t separator_before = 1;  // a piece begins where a line begins
  std::uint64_t return_before = 0;
  std::array<std::uint64_t, kPiece / kWord> begins;
  for (std::size_t at = 0; at < size; at += kWord) {
    hwy::Prefetch(text + at + kPrefetch);
    const WordMasks masks = masks_of(text + at, kSeparator == Separator::Comma ? kCommas : kBlanks);
    const std::uint64_t behind_separator = masks.separators << 1 | separator_before;
    const std::uint64_t behind_return = masks.carriage_returns << 1 | return_before;
    std::uint64_t ends = masks.separators & ~behind_separator;
    std::uint64_t line_ends = masks.line_ends;
    separator_before = masks.separators >> (kWord - 1);
    return_before = masks.carriage_returns >> (kWord - 1);
    const std::uint64_t more_separators = masks.separators & behind_separator;
    gaps |= more_separators;
    begins[at / kWord] = ~masks.separators & behind_separator;
    if ((behind_return & ~masks.line_ends) != 0) break;  // a CR that is no part of a line end
    std::uint64_t nothing = 0;                           // where a number is missing
    if constexpr (kSeparator == Separator::Comma) {
      nothing = more_separators & ~(behind_return & masks.line_ends);
      const std::uint64_t before = nothing == 0 ? ~std::uint64_t{0} : (nothing & -nothing) - 1;
      ends &= before;
      line_ends &= before;
    }
    const bool are_rows = append_lines(line_ends, ends, at, num_columns, index);
    // Rows may end in this word before the line that is none.
    append_places(ends, static_cast<std::uint32_t>(at), &index.ends[index.num_tokens]);
    index.num_tokens += static_cast<std::size_t>(std::popcount(ends));
    if (!are_rows || nothing != 0) break;
  }
  index.num_tokens = std::min(index.num_tokens, index.num_rows * num_columns);
  find_begins(begins.data(), gaps != 0, index);
}

template <Separator kSeparator>
NumberRows read_separated(const char* begin, const char* end, std::size_t num_columns,
                          std::size_t max_rows, double* out, const char** rows) {
  const auto index = std::make_unique_for_overwrite<Index>();
  NumberRows read{0, begin};
  while (true) {
    const auto rest = static_cast<std::size_t>(end - read.next);
    index_piece<kSeparator>(read.next, std::min(rest, kPiece) / kWord * kWord, num_columns, *index);
    const std::size_t most = std::min(index->num_rows, max_rows - read.num_rows);
    index->num_tokens = most * num_columns;
    const std::size_t num_tokens =
        read_tokens(read.next, *index, static_cast<std::size_t>(read.next - begin),
                    out + read.num_rows * num_columns);
    const std::size_t num_rows = num_tokens / num_columns;
    rows = append_begins(read.next, *index, num_rows, rows);
    if (num_rows == 0) return read;
    read.next += index->row_ends[num_rows - 1];
    read.num_rows += num_rows;
    if (num_rows < index->num_rows) return read;
  }
}

}  // namespace

NumberRows read_all(const char* begin, const char* end, std::size_t num_columns,
                    std::size_t max_rows, double* out, const char** rows, Separator separator) {
  return separator == Separator::Comma
             ? read_separated<Separator::Comma>(begin, end, num_columns, max_rows, out, rows)
             : read_separated<Separator::Blanks>(begin, end, num_columns, max_rows, out, rows);
}

#endif  // HWY_TARGET

}  // namespace HWY_NAMESPACE
}  // namespace kinefile::simd
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinefile::simd {
namespace {
HWY_EXPORT(read_all);
}  // namespace

NumberRows read_number_rows(const char* begin, const char* end, std::size_t num_columns,
                            std::size_t max_rows, double* out, const char** rows,
                            Separator separator) {
  return HWY_DYNAMIC_DISPATCH(read_all)(begin, end, num_columns, max_rows, out, rows, separator);
}

}  // namespace kinefile::simd
#endif  // HWY_ONCE
