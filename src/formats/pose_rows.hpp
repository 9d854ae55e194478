// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kinefile/pose_table.hpp"

namespace kinefile::tables {

/// A line of a pose table within a frame: a joint, or one of its tips.
struct PoseRow {
  std::string label;
  std::size_t joint = 0;
  std::size_t point = 0;  ///< index into the positions of joints, or of tips
  bool is_tip = false;
};

/// The lines of each frame, in the order of the table.
inline std::vector<PoseRow> pose_rows(const PoseTable& table) {
  const std::vector<Joint>& joints = table.skeleton->joints;
  const std::vector<std::size_t> first_tip = first_tips_of_joints(*table.skeleton);
  std::vector<PoseRow> rows;
  for (const std::size_t j : table.joints) {
    rows.push_back({joints[j].name, j, j, false});
    if (!table.tips) continue;
    for (std::size_t t = 0; t < joints[j].tips.size(); ++t) {
      rows.push_back({tip_label(joints[j], t), j, first_tip[j] + t, true});
    }
  }
  return rows;
}

/// The point of a line: three numbers in `poses`.
inline const double* point_of(const PoseArrays& poses, std::size_t frame, const PoseRow& row) {
  return row.is_tip ? &poses.tips[(frame * poses.num_tips + row.point) * 3]
                    : &poses.positions[(frame * poses.num_joints + row.point) * 3];
}

/// Appends the points of some frames, [frame][line][3], in the table's unit of length.
template <class T>
void append_points(const PoseTable& table, const std::vector<PoseRow>& rows,
                   const PoseArrays& poses, std::vector<T>& out) {
  std::size_t at = out.size();
  out.resize(at + poses.num_frames * rows.size() * 3);
  for (std::size_t f = 0; f < poses.num_frames; ++f) {
    for (const PoseRow& row : rows) {
      const double* const point = point_of(poses, f, row);
      for (std::size_t k = 0; k < 3; ++k) {
        out[at++] = static_cast<T>(point[k] * table.length_scale);
      }
    }
  }
}

/// Appends the numbers of an array of `poses` for the lines of some frames, [frame][line][width].
/// \param array  [frame][joint][width]
template <class T>
void append_of_joints(const std::vector<PoseRow>& rows, const PoseArrays& poses,
                      const Array<double>& array, std::size_t width, std::vector<T>& out) {
  std::size_t at = out.size();
  out.resize(at + poses.num_frames * rows.size() * width);
  for (std::size_t f = 0; f < poses.num_frames; ++f) {
    for (const PoseRow& row : rows) {
      const double* const numbers = &array[(f * poses.num_joints + row.joint) * width];
      for (std::size_t k = 0; k < width; ++k) out[at++] = static_cast<T>(numbers[k]);
    }
  }
}

}  // namespace kinefile::tables
