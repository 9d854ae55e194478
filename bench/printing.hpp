// SPDX-License-Identifier: MIT
#pragma once

namespace kinefile::bench {

/// Adds the measurements of printing rows of numbers, and their lines of the table.
void add_printing();

}  // namespace kinefile::bench
