// SPDX-License-Identifier: MIT
#pragma once

namespace kinefile::bench {

/// Adds the measurements of the checksum of archives, and their line of the table.
void add_checksum();

}  // namespace kinefile::bench
