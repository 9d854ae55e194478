// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/pose_table.hpp"

namespace kinefile::csv {

/// Writes a CSV table (see `Format::write_poses`): `frame,time,joint,x,y,z`, then `qw,qx,qy,qz` and
/// `ux,uy,uz` as requested; one row per frame and line.
bool write_poses(const PoseTable& table, PoseBlocks blocks, const kinefile::WriteOptions& options,
                 const Sink& sink);

}  // namespace kinefile::csv
