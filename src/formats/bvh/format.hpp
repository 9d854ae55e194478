// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/format.hpp"

namespace kinefile::bvh {

/// Biovision Hierarchy, read and written. See docs/formats/bvh.md.
Format format();

}  // namespace kinefile::bvh
