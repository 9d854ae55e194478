// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#pragma GCC visibility push(default)

namespace kinefile {

/// How many threads a call of the library uses at the most, the calling one included. At first this
/// is the number of cores that the process may use. Small inputs are worked on by one thread.
std::size_t max_threads();

/// Results do not depend on the number of threads.
/// \param count  1 or more; 0 for the number of cores
void set_max_threads(std::size_t count);

}  // namespace kinefile

#pragma GCC visibility pop
