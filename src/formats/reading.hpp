// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <utility>

#include "kinefile/format.hpp"

namespace kinefile {

/// Reads a document by `read_alone(bytes, options, diagnostics)`, to which the diagnostics of other
/// files are not shown: it fails if there are errors, and those are of this file.
template <class Read>
Result<Document> read_with_own_diagnostics(const Read& read_alone, std::string_view bytes,
                                           const ReadOptions& options, Diagnostics& diagnostics) {
  Diagnostics own;
  own.warnings_are_errors = diagnostics.warnings_are_errors;
  Result<Document> document = read_alone(bytes, options, own);
  // A warning may have become an error after the last look at them.
  if (document && own.has_errors()) document = fail(own.first_error());
  diagnostics.append(std::move(own));
  return document;
}

}  // namespace kinefile
