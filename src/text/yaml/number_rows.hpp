// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "simd/template_rows.hpp"
#include "text/attempts.hpp"
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
  /// Consumes a row. False if there is none, or if it may be something more (for example a key);
  /// then nothing has changed, and the text must be read like any other.
  /// \param is_in_flow  whether the row is in a flow sequence
  /// \param shape       out: the index of the row's shape
  bool take(Cursor& cursor, bool is_in_flow, std::size_t& shape);

  /// The numbers of the first row that was read and not popped yet; valid until `take`.
  std::span<const double> pop(std::size_t shape);

  const RowShape& shape(std::size_t index) const { return shapes_[index]; }
  /// How many numbers a row of a shape has.
  std::size_t num_values(std::size_t index) const { return num_values_[index]; }

 private:
  /// Rows that were read before they are taken: entries of a block sequence, a line each, that are
  /// like the row before them but for their numbers.
  struct Ahead {
    simd::RowTemplate row;  ///< from a row's bracket to that of the next one
    std::size_t tail = 0;   ///< bytes between a row and the next one
    std::size_t shape = 0;
    std::vector<double> values;
    std::vector<const char*> begins;  ///< of the rows, and of what follows them
    std::size_t num_taken = 0;

    bool has_row_at(const char* p) const {
      return num_taken + 1 < begins.size() && begins[num_taken] == p;
    }
  };

  const char* read_groups(const char* p, const char* end);
  std::size_t index_of_shape();
  void look_ahead(const char* begin, const char* row_end, const char* end, std::size_t shape);
  bool find_rows_ahead(const char* begin, const char* row_end, const char* end, std::size_t shape);
  void take_ahead(Cursor& cursor, std::size_t& shape);

  Ahead ahead_;
  Attempts attempts_;           ///< to find rows ahead
  std::vector<double> values_;  ///< of rows that were read and not popped
  std::size_t num_popped_ = 0;
  std::vector<RowShape> shapes_;
  std::vector<std::size_t> num_values_;  ///< of a row of each shape
  std::size_t last_shape_ = 0;
  RowShape current_;
  bool has_break_ = false;  ///< whether the row that was read spans several lines
};

}  // namespace kinefile::text::yaml
