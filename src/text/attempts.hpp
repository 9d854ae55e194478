// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

namespace kinefile::text {

/// When a reader of many rows at once is tried beside one that takes row by row: again behind the
/// next row while it finds some; where it finds none, the less often, up to every 64 rows, so that
/// no byte is looked at many times.
class Attempts {
 public:
  /// Whether to try now. If not, one more row has gone by.
  bool is_due() {
    if (num_left_ == 0) return true;
    --num_left_;
    return false;
  }

  void made(bool has_found_rows) {
    num_apart_ = has_found_rows ? 1 : std::min<std::size_t>(2 * num_apart_, 64);
    num_left_ = num_apart_;
  }

 private:
  std::size_t num_apart_ = 1;
  std::size_t num_left_ = 0;
};

}  // namespace kinefile::text
