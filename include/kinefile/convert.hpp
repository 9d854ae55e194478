// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/channels.hpp"
#include "kinefile/document.hpp"
#include "kinefile/format.hpp"

namespace kinefile {

/// Brings a document into a form that a format can write, where it is not in one already; the
/// world stays as it is. What had to be done is told in notes, what would be lost is an error.
/// Formats that write anything leave the document as it is.
/// \param channels  other channels that the motion is to have; its `lenient` leaves out what cannot
///                  be said, with a warning each
/// \errors those of bridge.hpp and of `with_channels`
Result<Document> adapted_to(const Format& format, Document document, const ChannelOptions& channels,
                            Diagnostics& diagnostics);

/// Whether two documents are written alike in a format: whether a motion still fits the skeleton
/// that it was read with, say.
bool are_written_alike(const Format& format, const Document& a, const Document& b);

/// Puts a document's motion on another skeleton (see `onto_skeleton`), with what that one's format
/// keeps of it.
/// \errors those of `onto_skeleton`; CNV001 (Usage) for a document without a motion
Result<Document> on_skeleton_of(const Document& skeleton, Document document,
                                Diagnostics& diagnostics);

}  // namespace kinefile
