// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "formats/bvh/syntax.hpp"
#include "kinefile/diagnostics.hpp"
#include "text/scanner.hpp"
#include "text/source.hpp"

namespace kinefile::bvh {

struct ParseOptions {
  bool lenient = false;   ///< repair the faults marked in docs/errors.md
  bool has_rate = false;  ///< the caller gives the frame rate, so the file need not
};

/// Reads a BVH text. All its faults are in `diagnostics`; the result is valid only if there are no
/// errors.
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
  /// Reports a fault that `--lenient` repairs: an error, or a warning that describes the repair.
  /// Returns whether it is repaired.
  /// \param hint  what `--lenient` would do, for the error; empty: it is not named
  bool repair(const char* code, std::string message, const std::string& remedy, const char* at,
              const std::string& hint = {}) {
    if (options.lenient) message += "; " + remedy;
    if (!options.lenient && !hint.empty()) message += "; --lenient " + hint;
    report(options.lenient ? Severity::Warning : Severity::Error, code, std::move(message), at);
    return options.lenient;
  }
};

/// Reads everything up to the word MOTION, which is consumed. Returns false if the rest cannot be
/// read.
bool parse_hierarchy(Parser& parser);

/// Where the rows of a motion begin, and how many the file says there are.
struct Body {
  const char* begin = nullptr;  ///< the first row, or the rest of the line before it
  std::optional<std::size_t> claim;
  const char* claim_at = nullptr;  ///< the place of that count, or of the first row
};

/// Reads what follows MOTION up to the rows; empty if there are none to read.
std::optional<Body> parse_counts(Parser& parser);

/// Reads the rows of numbers up to the end of the text.
void parse_rows(Parser& parser, const Body& body);

/// Sets the number of columns by the nodes' channels.
void count_columns(File& file);

/// The largest number of rows that some bytes could contain: if every number had one digit.
std::size_t most_rows(const File& file, std::size_t num_bytes);

/// Reports a count that is not that of the rows that were read.
void compare_with_claim(const text::Source& source, const Body& body, std::size_t num_frames,
                        Diagnostics& diagnostics);

/// Reads one number of the hierarchy or of the counts, with a diagnostic if it is not a number.
/// \param what  the expected text, for the message: "3 numbers after OFFSET"
std::optional<double> parse_value(Parser& parser, std::string_view token, const char* code,
                                  const std::string& what);

/// Skips a comment line, with a warning, if one starts here.
bool skip_comment(Parser& parser);

}  // namespace kinefile::bvh
