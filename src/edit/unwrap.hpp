// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "kinefile/motion.hpp"

namespace kinefile::edit {

/// Lets angles go on without jumps from a frame on: as `unwrap`, with the frame before it as the
/// start.
void unwrap_from(Motion& motion, std::size_t first_frame);

}  // namespace kinefile::edit
