// SPDX-License-Identifier: MIT
#pragma once

namespace kinefile::bench {

/// Compares the poses that `keyframe` chooses with those of greedy reduction, on a motion of 20
/// joints and 10 seconds, and prints the ratios of errors and how long it takes.
void print_keyframes();

}  // namespace kinefile::bench
