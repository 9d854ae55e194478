// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/differences.hpp"

namespace kinefile {

/// Compares components of the same kind and content.
Comparison compare_components(const BodyMotion& first, const BodyMotion& second, double tolerance);

/// Compares flows block by block.
Comparison compare_flows(const PoseFlow& first, const PoseFlow& second);

}  // namespace kinefile
