// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace kinefile::retime {

/// A pair of matching frames.
struct FramePair {
  std::size_t row = 0;
  std::size_t column = 0;
};

/// Finds the cheapest path from the first pair of two sequences to the last, by steps to the next
/// row, the next column or both.
/// \param num_rows, num_columns  1 or more
/// \param cost      of a pair, called once for each; a value that is not finite counts as very high
/// \returns         the pairs on the path, in order
/// At most three consecutive steps are straight along rows or along columns, so that neither
/// sequence is stretched much more than four times. If one is over three times as long as the
/// other, twice their ratio is allowed.
/// Source: Sakoe and Chiba, IEEE Trans. ASSP 26 (1978).
std::vector<FramePair> align_sequences(std::size_t num_rows, std::size_t num_columns,
                                       const std::function<double(std::size_t, std::size_t)>& cost);

}  // namespace kinefile::retime
