// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "kinefile/format.hpp"

namespace kinefile::urdf {

/// The Unified Robot Description Format (.urdf), read only; see docs/formats/body.md. None where
/// tinyxml2, a library of the machine, cannot be: in the browser build, for which
/// src/CMakeLists.txt takes absent.cpp in place of the reader.
std::vector<Format> formats();

}  // namespace kinefile::urdf
