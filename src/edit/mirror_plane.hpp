// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "kinefile/diagnostics.hpp"
#include "kinefile/motion.hpp"

namespace kinefile::edit {

/// How the halves of a skeleton belong together, and the plane in which its motion is mirrored.
struct MirrorPlane {
  std::vector<std::size_t> pairs;    ///< the partner of every joint; kNoParent if it has none
  Vec3 skeleton_normal;              ///< of the plane between the halves in the symmetric pose
  std::optional<std::size_t> frame;  ///< the symmetric pose; absent: all angles are 0
  std::size_t world_axis = 0;        ///< the normal of the mirror
  bool is_symmetric = true;          ///< the halves lie on the two sides of the plane in that pose
};

/// Finds the plane of a motion with joints. The halves are those of the rest pose, or of the most
/// symmetric frame if the rest pose is far from symmetric.
/// \param axis  the normal of the mirror in the world, if the caller chooses it
/// \errors EDT004 (Usage) if that axis points up
Result<MirrorPlane> find_mirror_plane(const Motion& motion, std::optional<std::size_t> axis,
                                      Diagnostics& diagnostics);

}  // namespace kinefile::edit
