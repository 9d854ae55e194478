// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "kinefile/array.hpp"
#include "text/attempts.hpp"
#include "text/row_pieces.hpp"
#include "text/yaml/characters.hpp"

namespace kinefile::text::yaml {

/// The shape of a row of numbers: n > 0 means n numbers, -n a sequence of n numbers, `kEmptyGroup`
/// an empty sequence. `[0.1, [1, 2], [3, 4]]` is {1, -2, -2}.
using RowShape = std::vector<std::int32_t>;

inline constexpr std::int32_t kEmptyGroup = std::numeric_limits<std::int32_t>::min();

/// Reads rows of plain numbers without one node per number: flow sequences of numbers and of
/// sequences of numbers, on one or several lines.
class NumberRows {
 public:
  /// Consumes a row; or several of one shape that are entries of a block sequence, a line each,
  /// and like the row before them but for their numbers. False if there is none, or if it may be
  /// something more (for example a key); then nothing has changed, and the text must be read like
  /// any other.
  /// \param is_in_flow  whether the row is in a flow sequence
  /// \param shape       out: the index of the rows' shape
  /// \param num_rows    out: how many
  bool take(Cursor& cursor, bool is_in_flow, std::size_t& shape, std::size_t& num_rows);

  /// The numbers of the first rows that were read and not popped yet; valid until `take`.
  std::span<const double> pop(std::size_t shape, std::size_t num_rows = 1);

  /// The text of one of several rows that were taken last.
  std::string_view text(std::size_t row) const {
    return {begins_[row], static_cast<std::size_t>(begins_[row + 1] - begins_[row]) - like_.tail};
  }

  const RowShape& shape(std::size_t index) const { return shapes_[index]; }
  /// How many numbers a row of a shape has.
  std::size_t num_values(std::size_t index) const { return num_values_[index]; }

 private:
  /// What rows may be like.
  struct LikeRows {
    RowReader reader;        ///< of rows from a bracket to the next one's
    std::size_t tail = 0;    ///< bytes between a row and the next one
    std::size_t indent = 0;  ///< of these, the bytes in the line of the next one
    std::size_t shape = 0;
    const char* next = nullptr;  ///< where such a row may be
  };

  const char* read_groups(const char* p, const char* end);
  std::size_t index_of_shape();
  void learn_row(const char* begin, const char* row_end, const char* end, std::size_t shape);
  bool take_like_rows(Cursor& cursor, std::size_t& shape, std::size_t& num_rows);
  const char* take_more_rows(const char* begin, const char* end);

  LikeRows like_;
  Attempts attempts_;                ///< to read rows that are like one
  std::vector<const char*> begins_;  ///< of rows that were taken at once, and of what follows them
  Array<double> values_;             ///< of rows that were read and not popped
  std::size_t num_popped_ = 0;
  std::vector<RowShape> shapes_;
  std::vector<std::size_t> num_values_;  ///< of a row of each shape
  std::size_t last_shape_ = 0;
  RowShape current_;
  bool has_break_ = false;  ///< whether the row that was read spans several lines
};

}  // namespace kinefile::text::yaml
