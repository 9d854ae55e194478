// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "formats/bvh/syntax.hpp"
#include "kinefile/diagnostics.hpp"
#include "text/scanner.hpp"
#include "text/source.hpp"

namespace kinefile::bvh {

struct ParseOptions {
  bool lenient = false;   ///< repair what docs/errors.md names
  bool has_rate = false;  ///< the caller says the frame rate, so the file need not
};

/// Reads a BVH text. What is wrong with it is in `diagnostics`, every fault of it; the result
/// counts only if there are no errors.
/// \param source  UTF-8 without a byte order mark; the result points into it
File parse(const text::Source& source, const ParseOptions& options, Diagnostics& diagnostics);

/// The state that the parts of the parser share.
struct Parser {
  const text::Source& source;
  const ParseOptions& options;
  Diagnostics& diagnostics;
  text::Scanner scanner;
  File file;
  bool is_structure_sound = true;  ///< the number of columns can be relied on

  void report(Severity severity, const char* code, std::string message, const char* at) {
    text::report(source, diagnostics, severity, code, std::move(message), at);
  }
  /// Reports a fault that `--lenient` repairs: an error, or a warning that tells the repair.
  /// Returns whether it is repaired.
  bool repair(const char* code, std::string message, const std::string& remedy, const char* at) {
    if (options.lenient) message += "; " + remedy;
    report(options.lenient ? Severity::Warning : Severity::Error, code, std::move(message), at);
    return options.lenient;
  }
};

/// Reads all up to the word MOTION, which is taken. Returns false if nothing beyond can be read.
bool parse_hierarchy(Parser& parser);

/// Reads what follows MOTION: the counts, then the rows.
void parse_motion(Parser& parser);

/// Reads the rows of numbers up to the end of the text.
/// \param begin     where they start, or the rest of the line before
/// \param claim     the file's own count of frames, if it has one
/// \param claim_at  where it says so
void parse_rows(Parser& parser, const char* begin, std::optional<std::size_t> claim,
                const char* claim_at);

/// Reads one number of the hierarchy or of the counts, with a diagnostic where it is none.
/// \param what  what was expected, for the message: "3 numbers after OFFSET"
std::optional<double> parse_value(Parser& parser, std::string_view token, const char* code,
                                  const std::string& what);

/// Passes over a comment line, with a warning, if one starts here.
bool skip_comment(Parser& parser);

}  // namespace kinefile::bvh
