// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kinefile/array.hpp"
#include "kinefile/timeline.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// The values of a motion: one row per frame, one column per coordinate of its skeleton.
struct Clip {
  std::size_t num_frames = 0;
  std::size_t num_coordinates = 0;
  Array<double> values;  ///< [frame][coordinate], in the file's own units, exactly as read
  Timeline timeline;

  std::span<const double> row(std::size_t frame) const {
    return {values.data() + frame * num_coordinates, num_coordinates};
  }
  /// The rows, for writing (see `Array::mutate`).
  Rows mutate() { return {values.mutate(), num_coordinates}; }
};

/// Whether a column equals `value` in every frame; true without frames, false for NaN.
bool is_always(const Clip& clip, std::size_t column, double value);

/// A clip of the given columns of another clip, in the given order.
Clip with_columns(const Clip& clip, const std::vector<std::size_t>& columns);

}  // namespace kinefile

#pragma GCC visibility pop
