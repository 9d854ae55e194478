// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "kinefile/format.hpp"
#include "kinefile/world_poses.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// The content of a table of poses.
struct PoseTable {
  const Skeleton* skeleton = nullptr;
  const Timeline* timeline = nullptr;
  std::vector<std::size_t> joints;  ///< the joints shown, in skeleton order
  bool rotations = false;
  bool directions = false;
  bool tips = false;
  double length_scale = 1;  ///< lengths are multiplied by this
};

/// Writes the header of a CSV table: `frame,time,joint,x,y,z`, then `qw,qx,qy,qz` and `ux,uy,uz`
/// as requested.
bool write_pose_csv_header(const PoseTable& table, const Sink& sink);

/// Writes one CSV row per frame and joint. A tip's row follows that of its joint and repeats its
/// rotation and direction. Returns false if the sink returned false.
/// \param poses  with the arrays that `table` requests
bool write_pose_csv(const PoseTable& table, const PoseArrays& poses, const Sink& sink);

/// Writes a JSON object: `joints` (tips among them), `frames`, `times`, `positions`
/// [frame][joint][3], and as requested `rotations` [frame][joint][4] and `directions`
/// [frame][joint][3]. Returns false if the sink returned false.
bool write_pose_json(const PoseTable& table, const PoseArrays& poses, const Sink& sink);

}  // namespace kinefile

#pragma GCC visibility pop
