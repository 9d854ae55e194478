// SPDX-License-Identifier: MIT
#pragma once

namespace kinefile::bench {

/// Adds the measurements of rows of numbers as different programs print them.
void add_rows();

}  // namespace kinefile::bench
