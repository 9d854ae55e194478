// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/document.hpp"
#include "kinefile/format.hpp"

namespace kinefile {

/// Brings a document into a form that a format can write, where it is not in one already; the
/// world stays as it is. What had to be done is told in notes, what would be lost is an error.
/// Formats that write anything leave the document as it is.
/// \param lenient  leave out what cannot be said, with a warning each
/// \errors those of bridge.hpp and of `with_channels`
Result<Document> adapted_to(const Format& format, Document document, bool lenient,
                            Diagnostics& diagnostics);

}  // namespace kinefile
