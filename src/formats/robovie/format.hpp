// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/format.hpp"

namespace kinefile::robovie {

/// RobovieMaker's motions, POSEDEF_WORD_N and POSEDEF_V1R4.
Format format();

}  // namespace kinefile::robovie
