// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "kinefile/motion.hpp"

namespace kinefile::edit {

/// Removes jumps of angles from a frame on: as `unwrap`, starting from the previous frame.
void unwrap_from(Motion& motion, std::size_t first_frame);

}  // namespace kinefile::edit
