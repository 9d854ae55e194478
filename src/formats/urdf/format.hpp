// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "kinefile/format.hpp"

namespace kinefile::urdf {

/// The Unified Robot Description Format (.urdf), read only; see docs/formats/body.md. Empty in the
/// browser build, which cannot link tinyxml2, a library of the system: there src/CMakeLists.txt
/// uses absent.cpp instead of the reader.
std::vector<Format> formats();

}  // namespace kinefile::urdf
