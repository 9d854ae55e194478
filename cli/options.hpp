// SPDX-License-Identifier: MIT
#pragma once

#include "command.hpp"

namespace kinefile::cli {

/// Refuses the first option that was given and means nothing for the formats at hand, by their
/// tables of options: neither for a file that was read nor for the output.
/// \param output  the format of the output, or null
/// \errors CLI003 (Usage)
Result<void> expect_options_of(const Reading& reading, const Format* output);

/// Refuses --skeleton where nothing has read it.
/// \errors CLI003 (Usage)
Result<void> expect_skeleton_used(const Reading& reading);

/// Both, at the end of a command that writes no document; what is wrong is reported. Returns the
/// exit code, no better than the one given.
int finish_reading(const Reading& reading, const Globals& globals, int exit_code);

/// Whether a table of a format has an option.
bool has_option(std::span<const std::string_view> table, std::string_view name);

}  // namespace kinefile::cli
