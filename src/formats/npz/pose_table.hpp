// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/pose_table.hpp"

namespace kinefile::npz {

/// Writes an archive of arrays (see `Format::write_poses`): `names`, `frames`, `times`, `positions`
/// [frame][line][3], and as requested `rotations` [frame][line][4] and `directions`
/// [frame][line][3].
bool write_poses(const PoseTable& table, PoseBlocks blocks, const kinefile::WriteOptions& options,
                 const Sink& sink);

}  // namespace kinefile::npz
