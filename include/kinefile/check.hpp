// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "kinefile/process.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// How to check a document.
struct CheckOptions {
  std::string name = {};      ///< the source name for diagnostics without a place
  DocumentSource robot = {};  ///< the robot that a body motion is applied to; null: it is not
                              ///< checked on a robot
  bool lenient = false;       ///< for `place`
};

/// Looks for problems that no format forbids (see `find_marks`): joints that turn suddenly (notes
/// MOT001, MOT002), joints that leave the limits of their degrees of freedom or are too fast
/// (MOT003, MOT004; for a robot one warning per degree of freedom, for a figure one note per
/// joint), jumps (MOT006), numbers that look as if they had another unit (MOT007 to MOT009),
/// components of different lengths or rates (BRG021), and names with characters that cannot be seen
/// or that differ in case alone (DOC002, DOC003). A body motion is checked on its robot; it is an
/// error if it cannot be applied to the robot.
void check(const Document& document, const CheckOptions& options, Diagnostics& diagnostics);

/// Reads a document, then checks it.
/// \param source  reads it
/// \errors those of `source`; they are also in `diagnostics`
Result<void> check(const DocumentSource& source, const CheckOptions& options,
                   Diagnostics& diagnostics);

}  // namespace kinefile

#pragma GCC visibility pop
