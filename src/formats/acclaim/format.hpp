// SPDX-License-Identifier: MIT
#pragma once

#include "formats/acclaim/kept.hpp"
#include "kinefile/format.hpp"

namespace kinefile::acclaim {

/// Acclaim Skeleton File, read and written. See docs/formats/acclaim.md.
Format asf_format();

/// Acclaim Motion Capture data, read and written; it needs its skeleton. See
/// docs/formats/acclaim.md.
Format amc_format();

/// A skeleton that was read from a file.
struct ReadSkeleton {
  AsfFile file;
  TextLayout text;
  double metres_per_quotient = kMetresPerInch;
};

/// Reads an ASF file's bytes. On failure every error is in `diagnostics`.
Result<ReadSkeleton> read_skeleton(std::string_view bytes, const ReadOptions& options,
                                   Diagnostics& diagnostics);

/// Finds the skeleton of a motion among the files beside it: the one that its header names; the one
/// with its own name, shortened at underscores (01.asf for 01_02.amc); the only one.
/// \param how  out: how it was found, as text
std::optional<CompanionFile> find_skeleton(const AmcHeader& header, const ReadOptions& options,
                                           std::string& how);

}  // namespace kinefile::acclaim
