// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "kinefile/process.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// How to check a document.
struct CheckOptions {
  std::string name = {};      ///< the source of diagnostics that have no place of their own
  DocumentSource robot = {};  ///< what a body motion is put on; null: it is not checked on a robot
  bool lenient = false;       ///< for `place`
};

/// Looks for what no format forbids: joints that turn suddenly (notes MOT001, MOT002), joints that
/// leave the limits of their degrees of freedom or are too fast (MOT003, MOT004; of a robot a
/// warning a degree of freedom, of a figure a note a joint). A body motion is checked on its robot;
/// what keeps it from that is an error.
void check(const Document& document, const CheckOptions& options, Diagnostics& diagnostics);

/// Reads a document, then checks it.
/// \param source  reads it
/// \errors those of `source`; they are among the diagnostics, too
Result<void> check(const DocumentSource& source, const CheckOptions& options,
                   Diagnostics& diagnostics);

}  // namespace kinefile

#pragma GCC visibility pop
