// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/format.hpp"

namespace kinefile::body {

/// Choreonoid's robot models (.body), read only. See docs/formats/body.md.
Format format();

}  // namespace kinefile::body
