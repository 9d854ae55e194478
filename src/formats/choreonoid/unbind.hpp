// SPDX-License-Identifier: MIT
#pragma once

#include "formats/choreonoid/print.hpp"
#include "kinefile/choreonoid.hpp"
#include "kinefile/document.hpp"
#include "kinefile/format.hpp"

namespace kinefile::choreonoid {

/// How a document is to be written. It must live as long as what is returned.
/// \errors SEQ027 if the document is no body motion, or has a rate that cannot be written
Result<PrintedFile> unbind(const Document& document, const WriteOptions& options,
                           Diagnostics& diagnostics);

}  // namespace kinefile::choreonoid
