// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinefile/format.hpp"
#include "text/decode.hpp"
#include "text/printer.hpp"
#include "text/source.hpp"

namespace kinefile {

/// Reads a document with `read_alone(bytes, options, diagnostics)`. That function does not see the
/// diagnostics of other files; the reading fails if this file has errors.
template <class Read>
Result<Document> read_with_own_diagnostics(const Read& read_alone, std::string_view bytes,
                                           const ReadOptions& options, Diagnostics& diagnostics) {
  Diagnostics own;
  own.warnings_are_errors = diagnostics.warnings_are_errors;
  Result<Document> document = read_alone(bytes, options, own);
  // The error may be a fault of the bytes themselves, which is not in the diagnostics yet.
  if (!document && !own.has_errors()) own.add(document.error());
  // A warning may have become an error after the last check.
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

/// Ends a writer: hands on the rest of what it printed.
/// \param printed  what came of it until here
/// \errors those of `printed`; IO003 if the sink ever returned false
inline Result<void> finish(text::Printer& printer, Result<void> printed = {}) {
  if (!printed || printer.finish()) return printed;
  return fail(make_error(ErrorKind::Io, "IO003", "the output was cut off"));
}

/// How the text of a file was encoded and what its lines ended with.
struct TextLayout {
  std::string encoding = {};         ///< in words: "utf-8 with BOM"
  std::string_view line_end = "lf";  ///< "lf", "crlf" or "cr"
};

/// \param view  of the text, without anything after its end
inline TextLayout layout_of(const text::DecodedText& decoded, std::string_view view) {
  return {decoded.description(), text::line_end_of(view)};
}

inline TextLayout layout_of(const text::DecodedText& decoded) {
  return layout_of(decoded, decoded.view());
}

/// The characters of the line end: "\r\n" or "\n".
inline std::string_view line_end_of(const TextLayout& layout) {
  return layout.line_end == "crlf" ? "\r\n" : "\n";
}

inline std::vector<Fact> facts_of(const TextLayout& layout) {
  const std::string line_end(layout.line_end);
  return {{"encoding", layout.encoding, layout.encoding},
          {"line_end", line_end, "line ends " + line_end}};
}

/// `Format::facts` of a format whose documents keep a `TextLayout` and no more.
inline std::vector<Fact> facts_of_layout(const Document& document) {
  const TextLayout* const kept = document.kept.get<TextLayout>();
  return kept == nullptr ? std::vector<Fact>() : facts_of(*kept);
}

/// \param name  the name of the format, which cannot store times of single frames
/// \errors `code` (DataLoss) if frames have times of their own
inline Result<void> expect_steady(const Clip& clip, const char* code, std::string_view name) {
  if (clip.num_frames == 0 || !has_own_times(clip.timeline)) return {};
  return fail(make_error(ErrorKind::DataLoss, code,
                         fmt::format("{} has no place for times of single frames; resample the "
                                     "motion, or bring it to a steady rate, first",
                                     name)));
}

}  // namespace kinefile
