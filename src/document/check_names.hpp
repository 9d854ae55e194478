// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/diagnostics.hpp"
#include "kinefile/document.hpp"

namespace kinefile {

/// Tells of names of joints and parts with characters that cannot be seen (DOC002), and notes those
/// that differ in case alone (DOC003).
void check_names(const Document& document, Diagnostics& diagnostics);

}  // namespace kinefile
