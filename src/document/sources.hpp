// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/process.hpp"

namespace kinefile {

/// The document of a source; null if there is no source.
/// \errors those of the source
inline Result<std::shared_ptr<const Document>> document_of(const DocumentSource& source,
                                                           Diagnostics& diagnostics) {
  if (!source) return std::shared_ptr<const Document>();
  return source(diagnostics);
}

/// The document of a source that must give a robot or a figure.
/// \errors those of the source; DOC001 (Usage) if its document has no skeleton
inline Result<std::shared_ptr<const Document>> model_of(const DocumentSource& source,
                                                        Diagnostics& diagnostics) {
  auto model = document_of(source, diagnostics);
  if (!model || *model == nullptr || has_skeleton(**model)) return model;
  return fail(wrong_kind(**model, "a robot or a skeleton"));
}

}  // namespace kinefile
