// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

#include "kinefile/format.hpp"

namespace kinefile::hrpsys {

/// The files of a set, by extension.
inline constexpr std::array<std::string_view, 4> kParts = {".pos", ".waist", ".hip", ".zmp"};

/// Reads a set of files, given one of them; the others are found through `options.companions`.
Result<Document> read(std::string_view bytes, const ReadOptions& options, Diagnostics& diagnostics);

}  // namespace kinefile::hrpsys
