// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinefile/kinefile.hpp"

namespace kinefile::cli {

using VariableValue = std::pair<std::size_t, std::int16_t>;

/// Reads "64=3" or "v64=3"; nothing if it is no variable and value.
std::optional<VariableValue> parse_variable_value(std::string_view text);

/// Reads what a person and sensors do from CSV: a column "tick", and as they apply "held" (0 or 1)
/// and variables "v64"; an empty cell changes nothing.
/// \errors RUN010 to RUN013 with their places
Result<std::vector<flow::Input>> parse_inputs(std::string_view text, const std::string& source);

}  // namespace kinefile::cli
