// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/format.hpp"

namespace kinefile::choreonoid {

/// Choreonoid's body motion, .seq.
Format format();

}  // namespace kinefile::choreonoid
