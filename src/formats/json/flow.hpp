// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/pose_flow.hpp"
#include "text/printer.hpp"

namespace kinefile::json {

/// Prints a flow of servo poses with all settings of its blocks: docs/formats/json.md.
void print_flow(text::Printer& printer, const PoseFlow& flow);

}  // namespace kinefile::json
