// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "formats/bvh/syntax.hpp"
#include "formats/files.hpp"

namespace kinefile::bvh {

/// The document of a file that was parsed without errors.
/// \param source  the text; its head is enough
Document document_of(File&& file, const text::Source& source, const TextLayout& layout,
                     const kinefile::ReadOptions& options, Diagnostics& diagnostics);

/// Reads a motion without holding its text (see `Format::read_pieces`): UTF-8, without errors
/// before its rows, with only plain rows and empty lines up to its end.
std::optional<Result<Document>> read_pieces(const ByteSource& bytes,
                                            const kinefile::ReadOptions& options,
                                            Diagnostics& diagnostics);

/// Opens a motion whose frames are read when they are asked for (see `Format::open_frames`).
std::optional<LongMotion> open_frames(const ByteSource& bytes, double most_bytes_in_memory,
                                      const kinefile::ReadOptions& options,
                                      Diagnostics& diagnostics);

}  // namespace kinefile::bvh
