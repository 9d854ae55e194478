// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/format.hpp"

namespace kinefile::hrpsys {

/// A set of text files with a common stem, which hrpsys and Choreonoid exchange: .pos (joints),
/// .waist (the root's pose), .hip (its roll, pitch and yaw), .zmp (relative to the root).
Format format();

}  // namespace kinefile::hrpsys
