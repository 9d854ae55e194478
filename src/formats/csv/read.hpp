// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/format.hpp"

namespace kinefile::csv {

/// Reads a table of a robot's motion: `time`, then `NAME.q` or NAME of joints in order of their
/// ids, `NAME.x` to `NAME.qz` of links, `NAME.x` to `NAME.z` of points; one row per frame. Also
/// reads a flow of servo poses, see flow_table.hpp.
Result<Document> read(std::string_view bytes, const kinefile::ReadOptions& options,
                      Diagnostics& diagnostics);

/// Reads such a table of a robot's motion without holding its text (see `Format::read_pieces`):
/// UTF-8, with rows whose text differs from the first one's in the numbers alone, and without
/// anything to say of later rows.
std::optional<Result<Document>> read_pieces(const ByteSource& bytes,
                                            const kinefile::ReadOptions& options,
                                            Diagnostics& diagnostics);

}  // namespace kinefile::csv
