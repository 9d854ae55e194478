// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

#include "command.hpp"

namespace kinefile::cli {

/// The skeleton or robot that `--skeleton` names, read on demand; null if none is given.
/// \param reading  must outlive the source
inline DocumentSource source_of_skeleton(const Reading& reading) {
  if (reading.skeleton.empty()) return {};
  return [&reading](Diagnostics& diagnostics) -> Result<std::shared_ptr<const Document>> {
    auto loaded = load_skeleton(reading, diagnostics);
    if (!loaded) return fail(std::move(loaded.error()));
    return std::make_shared<const Document>(std::move(**loaded));
  };
}

}  // namespace kinefile::cli
