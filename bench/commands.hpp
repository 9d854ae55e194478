// SPDX-License-Identifier: MIT
#pragma once

namespace kinefile::bench {

/// Whole jobs, from a file to a file.
void add_commands();

}  // namespace kinefile::bench
