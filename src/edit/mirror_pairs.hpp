// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "kinefile/skeleton.hpp"

namespace kinefile::edit {

/// The partner of every joint by its name only; shape (joints); kNoParent if there is none. Several
/// joints with the partner's name are paired in their order, if they have the same depth.
std::vector<std::size_t> pairs_by_name(const Skeleton& skeleton);

/// The partner of every joint: by name, otherwise itself if it lies in the plane through its root,
/// otherwise by its position in the rest pose; shape (joints); kNoParent if there is none.
/// \param axis  the normal of the mirror
std::vector<std::size_t> mirror_pairs(const Skeleton& skeleton, std::size_t axis);

/// Whether the pairs, all together, lie on the two sides of a mirror plane: further apart along its
/// normal than across it.
bool lie_opposite(const Skeleton& skeleton, const std::vector<std::size_t>& pairs,
                  std::size_t axis);

}  // namespace kinefile::edit
