// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "kinefile/format.hpp"

namespace kinefile {

using OpenedFiles = std::shared_ptr<std::vector<CompanionFile>>;

/// The same files; each one that is found is added to those that were opened.
/// \param opened  null: nobody asks
Resolver recording(Resolver inner, const OpenedFiles& opened);

/// Reads the skeleton that the caller named, if motions of the format take one and it is not there
/// yet.
/// \param format   null: none is read
/// \param options  in: with the skeleton's name; out: with the skeleton
/// \errors those of `read_file`
Result<void> read_named_skeleton(const Format* format, ReadOptions& options,
                                 Diagnostics& diagnostics);

}  // namespace kinefile
