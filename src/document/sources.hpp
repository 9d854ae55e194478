// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/process.hpp"

namespace kinefile {

/// What a source gives; null where there is no source.
/// \errors those of the source
inline Result<std::shared_ptr<const Document>> document_of(const DocumentSource& source,
                                                           Diagnostics& diagnostics) {
  if (!source) return std::shared_ptr<const Document>();
  return source(diagnostics);
}

/// The same of a source that is to give a robot or a figure.
/// \errors those of the source; DOC001 (Usage) if what it gives has no skeleton
inline Result<std::shared_ptr<const Document>> model_of(const DocumentSource& source,
                                                        Diagnostics& diagnostics) {
  auto model = document_of(source, diagnostics);
  if (!model || *model == nullptr || has_skeleton(**model)) return model;
  return fail(wrong_kind(**model, "a robot or a skeleton"));
}

}  // namespace kinefile
