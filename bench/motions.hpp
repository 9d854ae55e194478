// SPDX-License-Identifier: MIT
#pragma once

namespace kinefile::bench {

/// Adds the measurements of kinematics and retiming.
void add_motions();

/// Prints how far kinefile and the baselines are apart.
void print_disagreements();

}  // namespace kinefile::bench
