// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/format.hpp"

namespace kinefile::urdf {

/// The Unified Robot Description Format (.urdf), read only; see docs/formats/body.md.
Format format();

}  // namespace kinefile::urdf
