// SPDX-License-Identifier: MIT
// Rows whose text between the numbers is known are read as those of numbers alone are
// (number_rows.cpp), but for the first pass: from the table of token ends each number is found
// behind the text before it, which is compared, up to the next end. So commas, brackets and names
// need no machine of their own: a row with other ones is not read.
// Highway compiles this file once for every instruction set and selects one at run time.

#include "simd/template_rows.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <memory>

#ifdef __EMSCRIPTEN__
#define HWY_COMPILE_ONLY_EMU128  // WebAssembly has no vectors of doubles in Highway 1.0
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/template_rows.cpp"
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
NumberRows read_templated(const char* begin, const char* end, const RowTemplate& row,
                          std::size_t max_rows, double* out, const char** rows);
}
#endif

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {
#if KINEFILE_HAS_WIDE_MASKS

NumberRows read_templated(const char* begin, const char* end, const RowTemplate& row,
                          std::size_t max_rows, double* out, const char** rows) {
  return N_AVX2::read_templated(begin, end, row, max_rows, out, rows);
}

#elif HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128

// Without vectors the other readers are as fast.
NumberRows read_templated(const char* begin, const char*, const RowTemplate&, std::size_t, double*,
                          const char**) {
  return {0, begin};
}

#else
namespace {

/// The ends of all tokens of a piece, and the numbers among them.
struct TemplateIndex {
  Index numbers;
  std::size_t num_ends = 0;
  std::array<std::uint32_t, kPiece / 2 + kWord> ends;
};

HWY_INLINE std::uint64_t separators_of(const char* text) {
  const Bytes d;
  std::uint64_t separators = 0;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(text);
  // The low four bits choose the separator that a byte must equal; two share theirs.
  alignas(16) static constexpr std::uint8_t kSeparators[16] = {
      ' ', 0, 0, 0, 0, 0, 0, 0, 0, '\t', '\n', '[', ',', '\r', 0, 0};
  const auto table = hn::LoadDup128(d, kSeparators);
  const auto low = hn::Set(d, 0x0F);
  for (std::size_t i = 0; i < kWord; i += hn::Lanes(d)) {
    const auto v = hn::LoadU(d, bytes + i);
    const auto is_listed = hn::TableLookupBytes(table, hn::And(v, low)) == v;
    separators |= bits_of(d, hn::Or(is_listed, v == hn::Set(d, ']'))) << i;
  }
  return separators;
}

/// Finds where the tokens of a piece end.
/// \param size  bytes, a multiple of kWord
HWY_INLINE void index_ends(const char* text, std::size_t size, TemplateIndex& index) {
  index.num_ends = 0;
  std::uint64_t separator_before = 1;  // a piece begins where a row begins
  for (std::size_t at = 0; at < size; at += kWord) {
    hwy::Prefetch(text + at + kPrefetch);
    const std::uint64_t separators = separators_of(text + at);
    const std::uint64_t ends = separators & ~(separators << 1 | separator_before);
    separator_before = separators >> (kWord - 1);
    append_places(ends, static_cast<std::uint32_t>(at), &index.ends[index.num_ends]);
    index.num_ends += static_cast<std::size_t>(std::popcount(ends));
  }
}

/// Finds the ends of a row's numbers among those of all its words.
HWY_INLINE void take_ends(const std::uint32_t* row_ends, const RowTemplate& row,
                          std::uint32_t* ends) {
  const std::size_t num_columns = row.num_columns();
  const std::uint32_t* const places = row.end_places().data();
  if (row.end_places().back() == num_columns - 1) {  // no words but numbers
    std::copy_n(row_ends, num_columns, ends);
    return;
  }
  for (std::size_t c = 0; c < num_columns; ++c) ends[c] = row_ends[places[c]];
}

/// Finds where a row's numbers begin; whether each does before its end.
HWY_INLINE bool find_row_begins(std::uint32_t at, const RowTemplate& row, const std::uint32_t* ends,
                                std::uint32_t* begins) {
  const std::size_t num_columns = row.num_columns();
  const std::uint32_t* const sizes = row.gap_sizes().data();
  begins[0] = at + sizes[0];
  std::uint32_t num_wrong = begins[0] >= ends[0];
  for (std::size_t c = 1; c < num_columns; ++c) {
    begins[c] = ends[c - 1] + sizes[c];
    num_wrong |= begins[c] >= ends[c];
  }
  return num_wrong == 0;
}

/// Whether a row has the template's text.
HWY_INLINE bool has_text(const char* text, std::uint32_t at, const RowTemplate& row,
                         const std::uint32_t* ends) {
  const RowTemplate::Word* word = row.words().data();
  const RowTemplate::Word* const last = word + row.words().size();
  std::uint64_t difference = 0;
  const auto look_at = [&](const char* gap) HWY_ATTR {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, gap + word->place, 8);
    difference |= (bytes ^ word->bytes) & word->mask;
  };
  for (; word != last && word->gap == 0; ++word) look_at(text + at);
  for (; word != last; ++word) look_at(text + ends[word->gap - 1]);
  return difference == 0;
}

/// Finds the numbers of the next row of a piece; whether it has the template's text.
/// \param at    in: where the row begins; out: where the next one does
/// \param next  in: the number of the row's first end; out: likewise
HWY_INLINE bool find_row(const char* text, std::size_t size, const RowTemplate& row,
                         TemplateIndex& index, std::uint32_t& at, std::size_t& next) {
  if (next + row.num_ends() > index.num_ends) return false;
  const std::size_t first = index.numbers.num_tokens;
  std::uint32_t* const ends = &index.numbers.ends[first];
  take_ends(&index.ends[next], row, ends);
  // No gap begins behind the last one, so that all their bytes can be read.
  const std::uint32_t last_end = ends[row.num_columns() - 1];
  if (last_end + row.reach() > size) return false;
  if (!find_row_begins(at, row, ends, &index.numbers.begins[first])) return false;
  if (!has_text(text, at, row, ends)) return false;
  at = last_end + row.gap_sizes().back();
  next += row.num_ends();
  return true;
}

/// Finds the first rows of a piece that have the template's text, and their numbers.
HWY_INLINE void find_rows(const char* text, std::size_t size, const RowTemplate& row,
                          std::size_t max_rows, TemplateIndex& index) {
  Index& numbers = index.numbers;
  numbers.num_tokens = numbers.num_rows = 0;
  std::uint32_t at = 0;
  std::size_t next = 0;
  while (numbers.num_rows < max_rows && find_row(text, size, row, index, at, next)) {
    numbers.num_tokens += row.num_columns();
    numbers.row_ends[numbers.num_rows++] = at;
  }
}

}  // namespace

NumberRows read_templated(const char* begin, const char* end, const RowTemplate& row,
                          std::size_t max_rows, double* out, const char** rows) {
  const std::size_t num_columns = row.num_columns();
  const auto index = std::make_unique_for_overwrite<TemplateIndex>();
  const Index& numbers = index->numbers;
  NumberRows read{0, begin};
  // The first piece has room for a few rows, so that little is done in vain where one is soon odd.
  std::size_t most_bytes =
      std::min(kWord + 4 * (8 * row.words().size() + 16 * num_columns), kPiece);
  while (true) {
    const auto rest = static_cast<std::size_t>(end - read.next);
    const std::size_t size = std::min(rest, most_bytes) / kWord * kWord;
    most_bytes = std::min(4 * most_bytes, kPiece);
    index_ends(read.next, size, *index);
    find_rows(read.next, size, row, max_rows - read.num_rows, *index);
    const std::size_t num_tokens =
        read_tokens(read.next, numbers, static_cast<std::size_t>(read.next - begin),
                    out + read.num_rows * num_columns);
    const std::size_t num_rows = num_tokens / num_columns;
    rows = append_begins(read.next, numbers, num_rows, rows);
    if (num_rows == 0) return read;
    read.next += numbers.row_ends[num_rows - 1];
    read.num_rows += num_rows;
    if (num_rows < numbers.num_rows) return read;
  }
}

#endif  // HWY_TARGET

}  // namespace HWY_NAMESPACE
}  // namespace kinefile::simd
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinefile::simd {
namespace {
HWY_EXPORT(read_templated);
}  // namespace

void RowTemplate::add_gap(std::string_view text) {
  const auto gap = static_cast<std::uint32_t>(gap_sizes_.size());
  // Before the first number stands the end of a row, and before any other text a number.
  if (gap > 0) end_places_.push_back(static_cast<std::uint32_t>(num_ends_++));
  bool is_in_word = gap > 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (is_in_word && is_separator(text[i]) && i > 0) ++num_ends_;
    is_in_word = !is_separator(text[i]);
  }
  for (std::size_t i = 0; i < text.size(); i += 8) {
    constexpr char kAll[8] = {'\xFF', '\xFF', '\xFF', '\xFF', '\xFF', '\xFF', '\xFF', '\xFF'};
    const std::size_t count = std::min<std::size_t>(text.size() - i, 8);
    Word& word = words_.emplace_back();
    std::memcpy(&word.bytes, text.data() + i, count);
    std::memcpy(&word.mask, kAll, count);
    word.gap = gap;
    word.place = static_cast<std::uint32_t>(i);
    reach_ = std::max(reach_, i + 8);
  }
  gap_sizes_.push_back(static_cast<std::uint32_t>(text.size()));
}

NumberRows read_template_rows(const char* begin, const char* end, const RowTemplate& row,
                              std::size_t max_rows, double* out, const char** rows) {
  if (row.num_columns() == 0) return {0, begin};
  return HWY_DYNAMIC_DISPATCH(read_templated)(begin, end, row, max_rows, out, rows);
}

}  // namespace kinefile::simd
#endif  // HWY_ONCE
