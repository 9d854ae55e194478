// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "many.hpp"

namespace kinefile::cli {

/// The files of a run over many.
struct Plan {
  std::vector<ManyFile> files;
  Diagnostics notes;  ///< about what is passed over
};

/// Finds the input files and names their outputs: the path below a folder that was given, else the
/// file's name, with the extension of the output's format. Skeletons that lie beside the motions
/// that are read with them are no inputs themselves.
/// \errors CLI001 (Usage) if two outputs would have one name, or one would replace an input, or a
///         folder has no files; IO001 if a folder cannot be listed
Result<Plan> plan_of(const Many& many, const ManyWork& work);

}  // namespace kinefile::cli
