// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/format.hpp"

namespace kinefile::npz {

/// NumPy's archive of arrays, for poses. Only written.
Format format();

}  // namespace kinefile::npz
