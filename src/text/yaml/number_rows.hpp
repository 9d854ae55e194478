// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "text/yaml/characters.hpp"

namespace kinefile::text::yaml {

/// What a row of numbers looks like: a number above zero stands for so many numbers, one below for
/// a sequence of so many, `kEmptyGroup` for an empty one. `[0.1, [1, 2], [3, 4]]` is {1, -2, -2}.
using RowShape = std::vector<std::int32_t>;

inline constexpr std::int32_t kEmptyGroup = std::numeric_limits<std::int32_t>::min();

/// Reads rows of plain numbers, which are to need no node a number: flow sequences of numbers and
/// of sequences of numbers, on one line or several.
class NumberRows {
 public:
  /// Reads a row and goes behind it. False where there is none, or where it may be more than that
  /// (a key, say): then nothing has changed, and the text is to be read like any other.
  /// \param is_in_flow  whether the row stands in a flow sequence
  /// \param shape       the index of the row's shape
  bool take(Cursor& cursor, bool is_in_flow, std::size_t& shape);

  /// The numbers of the row that was read first and not popped yet; valid until `take`.
  std::span<const double> pop(std::size_t shape);

  const RowShape& shape(std::size_t index) const { return shapes_[index]; }
  /// How many numbers a row of a shape has.
  std::size_t num_values(std::size_t index) const { return num_values_[index]; }

 private:
  const char* read_groups(const char* p, const char* end);
  std::size_t index_of_shape();

  std::vector<double> values_;  ///< of rows that were read and not popped
  std::size_t num_popped_ = 0;
  std::vector<RowShape> shapes_;
  std::vector<std::size_t> num_values_;  ///< of a row of each shape
  std::size_t last_shape_ = 0;
  RowShape current_;
  bool has_break_ = false;  ///< whether the row that was read goes over several lines
};

}  // namespace kinefile::text::yaml
