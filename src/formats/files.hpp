// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

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
  // What ended the reading may be a fault of the bytes as such, which nobody noted.
  if (!document && !own.has_errors()) own.add(document.error());
  // A warning may have become an error after the last look at them.
  if (document && own.has_errors()) document = fail(own.first_error());
  diagnostics.append(std::move(own));
  return document;
}

/// \param wanted  what the format writes, for the error: "a motion to write as AMC"
/// \errors DOC001 (Usage) for a document of another kind, MDL001 or MDL002 for one that is not
/// valid
inline Result<void> expect_kind(const Document& document, const Kinds& kinds,
                                std::string_view wanted) {
  if (!contains(kinds, document)) return fail(wrong_kind(document, wanted));
  return validate(document);
}

/// \param name  the format's, which has no place for times of single frames
/// \errors `code` (DataLoss) if frames have times of their own
inline Result<void> expect_steady(const Clip& clip, const char* code, std::string_view name) {
  if (clip.num_frames == 0 || !has_own_times(clip.timeline)) return {};
  return fail(make_error(ErrorKind::DataLoss, code,
                         fmt::format("{} has no place for times of single frames; resample the "
                                     "motion, or bring it to a steady rate, first",
                                     name)));
}

/// The line end that a document's file had, "\n" or "\r\n"; "\n" where nothing is kept of it.
inline std::string_view kept_line_end(const Extras& extras) {
  const auto kept = extras.file.find("line_end");
  return kept != extras.file.end() && kept->second == "crlf" ? "\r\n" : "\n";
}

}  // namespace kinefile
