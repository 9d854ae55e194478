// SPDX-License-Identifier: MIT
#pragma once

namespace kinefile::bench {

/// Adds the measurements of many files.
void add_batch();

}  // namespace kinefile::bench
