// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kinefile/timeline.hpp"

namespace kinefile {

/// The values of a motion: one row a frame, one column a coordinate of its skeleton.
struct Clip {
  std::size_t num_frames = 0;
  std::size_t num_coordinates = 0;
  std::vector<double> values;  ///< [frame][coordinate], in the file's own units, exactly as read
  Timeline timeline;

  std::span<const double> row(std::size_t frame) const {
    return {values.data() + frame * num_coordinates, num_coordinates};
  }
  std::span<double> row(std::size_t frame) {
    return {values.data() + frame * num_coordinates, num_coordinates};
  }
};

}  // namespace kinefile
