// SPDX-License-Identifier: MIT
#pragma once

#include "formats/choreonoid/print.hpp"
#include "kinefile/choreonoid.hpp"
#include "kinefile/document.hpp"
#include "kinefile/format.hpp"

namespace kinefile::choreonoid {

/// The content of the file for a document. The document must outlive the result.
/// \errors SEQ027 if the document is not a body motion, or has a rate that cannot be written
Result<PrintedFile> unbind(const Document& document, const WriteOptions& options,
                           Diagnostics& diagnostics);

}  // namespace kinefile::choreonoid
