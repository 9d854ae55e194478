// SPDX-License-Identifier: MIT
#pragma once

namespace kinefile::bench {

/// Adds the measurements of operations on the rotations of a motion in memory.
void add_operations();

/// Prints how far the results of operations and those of the baselines are apart.
void print_operation_disagreements();

}  // namespace kinefile::bench
