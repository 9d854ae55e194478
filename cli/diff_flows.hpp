// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "json_output.hpp"
#include "kinefile/kinefile.hpp"

namespace kinefile::cli {

/// One thing in which two flows differ.
struct FlowDifference {
  std::optional<std::size_t> block;  ///< none: of the flow as a whole
  std::string what;                  ///< "ticks", "s3", "next", "name", ...
  std::string first, second;         ///< as a file has it; empty: it is not there
};

/// Compares flows block by block, in the order of their numbers. Where the editor draws blocks and
/// how long arrows are is no difference.
std::vector<FlowDifference> compare_flows(const PoseFlow& first, const PoseFlow& second);

void print_text(const std::vector<FlowDifference>& differences);
Json json_of(const std::vector<FlowDifference>& differences);

}  // namespace kinefile::cli
