// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/retime.hpp"

namespace kinefile::retime {

/// Whether the numbers of an ease are valid: a positive power, a Bezier curve that is a function.
bool is_valid(const Ease& ease);

/// Whether an ease decreases anywhere, as Bezier curves with overshoot do.
bool goes_back(const Ease& ease);

}  // namespace kinefile::retime
