// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/format.hpp"

namespace kinefile::csv {

/// Comma-separated values (RFC 4180): a row a frame, a column a coordinate. Tables of robots are
/// read, too.
Format format();

}  // namespace kinefile::csv
