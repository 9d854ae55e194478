// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/format.hpp"

namespace kinefile::json {

/// JSON: the skeleton, the names of the columns, the values. Only written.
Format format();

}  // namespace kinefile::json
