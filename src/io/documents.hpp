// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/format.hpp"

namespace kinefile {

/// Reads the skeleton that the caller named, if motions of the format take one and it is not there
/// yet.
/// \param format   null: none is read
/// \param options  in: with the skeleton's name; out: with the skeleton
/// \errors those of `read_file`
Result<void> read_named_skeleton(const Format* format, ReadOptions& options,
                                 Diagnostics& diagnostics);

}  // namespace kinefile
