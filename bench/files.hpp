// SPDX-License-Identifier: MIT
#pragma once

namespace kinefile::bench {

/// Adds the measurements of reading and writing whole files.
void add_files();

/// Prints the most memory that reading needs. To be called before this process has grown.
void print_memory();

}  // namespace kinefile::bench
