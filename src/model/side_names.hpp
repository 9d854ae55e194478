// SPDX-License-Identifier: MIT
// The two halves of a skeleton, told by the names of its joints.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kinefile/skeleton.hpp"

namespace kinefile {

/// The partner of every joint by its name only; shape (joints); kNoParent if there is none. Names
/// differ in Left/Right and 左/右 anywhere, or in l/r and L/R as a word or as the first or last
/// letter of a word. Several joints with the partner's name are paired in their order, if they have
/// the same depth.
std::vector<std::size_t> pairs_by_name(const Skeleton& skeleton);

/// Whether the first of two names of partners is that of the left one.
bool is_left_of(const std::string& name, const std::string& partner);

/// Whether a name certainly says a side: Left, Right, 左, 右. A letter may mean another thing, such
/// as the roll of WAIST_R.
bool has_side(const std::string& name);

/// The number of ancestors of every joint; shape (joints).
std::vector<std::size_t> depths_of(const Skeleton& skeleton);

}  // namespace kinefile
