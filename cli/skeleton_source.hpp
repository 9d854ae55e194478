// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "command.hpp"

namespace kinefile::cli {

/// The skeleton or robot in a file, read on demand with the options of `reading`; null for no file.
/// \param reading  must outlive the source
inline DocumentSource source_of(const std::string& path, const Reading& reading) {
  if (path.empty()) return {};
  return [path, &reading](Diagnostics& diagnostics) -> Result<std::shared_ptr<const Document>> {
    Reading of_robot = reading;
    of_robot.skeleton = path;
    const bool is_named = path == reading.skeleton;
    auto loaded = load_skeleton(is_named ? reading : of_robot, diagnostics);
    if (!loaded) return fail(std::move(loaded.error()));
    return std::make_shared<const Document>(std::move(**loaded));
  };
}

/// The same document, which is read only once: its diagnostics come the first time.
inline DocumentSource read_once(DocumentSource source) {
  if (!source) return source;
  auto known = std::make_shared<std::shared_ptr<const Document>>();
  return [known, source = std::move(source)](
             Diagnostics& diagnostics) -> Result<std::shared_ptr<const Document>> {
    if (*known != nullptr) return *known;
    auto read = source(diagnostics);
    if (read) *known = *read;
    return read;
  };
}

/// The skeleton or robot that `--skeleton` names; null if none is given.
/// \param reading  must outlive the source
inline DocumentSource source_of_skeleton(const Reading& reading) {
  return source_of(reading.skeleton, reading);
}

}  // namespace kinefile::cli
