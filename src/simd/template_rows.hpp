// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "simd/number_rows.hpp"

namespace kinefile::simd {

/// Whether rows with a template are read at all; the browser's build has no vectors for them, and
/// no bytes for what would never run.
#ifdef __EMSCRIPTEN__
inline constexpr bool kReadsTemplateRows = false;
#else
inline constexpr bool kReadsTemplateRows = true;
#endif

/// Whether a character ends a number in rows with a template.
constexpr bool is_separator(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ',' || c == '[' || c == ']';
}

/// The text of rows that are alike but for their numbers, such as `- [ 0.1, 0.2 ]`.
class RowTemplate {
 public:
  /// Adds the text before the first number, then the text behind each number, the last of which
  /// goes to the end of the row.
  void add_gap(std::string_view text);

  std::size_t num_columns() const { return gap_sizes_.empty() ? 0 : gap_sizes_.size() - 1; }

  /// Eight bytes of a gap's text, and which of them count.
  struct Word {
    std::uint64_t bytes = 0;
    std::uint64_t mask = 0;
    std::uint32_t gap = 0;
    std::uint32_t place = 0;  ///< from the gap's beginning
  };
  const std::vector<Word>& words() const { return words_; }
  /// The bytes of each gap.
  const std::vector<std::uint32_t>& gap_sizes() const { return gap_sizes_; }
  /// Where the end of each number stands among the ends of all words of a row.
  const std::vector<std::uint32_t>& end_places() const { return end_places_; }
  /// How many words of a row end in it, numbers and others.
  std::size_t num_ends() const { return num_ends_; }
  /// How far the words of a gap reach at the most, in bytes.
  std::size_t reach() const { return reach_; }

 private:
  std::vector<Word> words_;  ///< those of the first gap first
  std::vector<std::uint32_t> gap_sizes_;
  std::vector<std::uint32_t> end_places_;
  std::size_t num_ends_ = 0;
  std::size_t reach_ = 0;
};

/// Reads rows that have the text of a template, exact to the last bit, until one that has not, or
/// with a token that is no finite number (see `read_number_rows`).
/// \param begin  the beginning of a row
/// \param end    where the text ends; some rows before it may be left to another reader
/// \param out    room for `max_rows` rows; shape (max_rows, num_columns)
/// \param rows   out: where each row begins; room for `max_rows`; null: not wanted
NumberRows read_template_rows(const char* begin, const char* end, const RowTemplate& row,
                              std::size_t max_rows, double* out, const char** rows = nullptr);

}  // namespace kinefile::simd
