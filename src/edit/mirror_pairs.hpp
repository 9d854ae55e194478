// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "kinefile/skeleton.hpp"

namespace kinefile::edit {

/// The other half of every joint by its name alone; shape (joints); kNoParent where there is none.
/// Joints that have the other's name are paired in their order, if they lie equally deep.
std::vector<std::size_t> pairs_by_name(const Skeleton& skeleton);

/// The other half of every joint: by name, else itself if it lies in the plane through its root,
/// else by where it lies in the rest pose; shape (joints); kNoParent where there is none.
/// \param axis  the normal of the mirror
std::vector<std::size_t> mirror_pairs(const Skeleton& skeleton, std::size_t axis);

/// Whether the two halves lie on the two sides of a mirror, all pairs together: further apart along
/// its normal than across it.
bool lie_opposite(const Skeleton& skeleton, const std::vector<std::size_t>& pairs,
                  std::size_t axis);

}  // namespace kinefile::edit
