// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/pose_table.hpp"

namespace kinefile::json {

/// Writes a JSON object (see `Format::write_poses`): `joints` (tips among them), `frames`, `times`,
/// `positions` [frame][line][3], and as requested `rotations` [frame][line][4] and `directions`
/// [frame][line][3].
bool write_poses(const PoseTable& table, PoseBlocks blocks, const WriteOptions& options,
                 const Sink& sink);

}  // namespace kinefile::json
