// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/format.hpp"

namespace kinefile::csv {

/// Comma-separated values (RFC 4180): one row per frame, one column per coordinate. Tables of
/// robots are read, too.
Format format();

}  // namespace kinefile::csv
