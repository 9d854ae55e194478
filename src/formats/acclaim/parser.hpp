// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "formats/acclaim/codes.hpp"
#include "formats/acclaim/lexer.hpp"
#include "formats/acclaim/syntax.hpp"
#include "kinefile/diagnostics.hpp"
#include "text/source.hpp"

namespace kinefile::acclaim {

/// The state that the parts of a parser share.
struct Parser {
  const text::Source& source;
  bool lenient = false;  ///< repair the faults marked in docs/errors.md
  Diagnostics& diagnostics;
  Lexer lexer;

  void report(Severity severity, const char* code, std::string message, const char* at) {
    text::report(source, diagnostics, severity, code, std::move(message), at);
  }
  void error(const char* code, std::string message, const char* at) {
    report(Severity::Error, code, std::move(message), at);
  }
  void warn(const char* code, std::string message, const char* at) {
    report(Severity::Warning, code, std::move(message), at);
  }
  /// Notes what the file does not say, and what is taken for it.
  void note_not_said(std::string message, const char* at) {
    report(Severity::Note, code::kNotSaid, std::move(message), at);
  }
  /// Reports a fault that `--lenient` repairs: an error, or a warning that describes the repair.
  /// Returns whether it is repaired.
  bool repair(const char* code, std::string message, const std::string& remedy, const char* at) {
    if (lenient) message += "; " + remedy;
    report(lenient ? Severity::Warning : Severity::Error, code, std::move(message), at);
    return lenient;
  }
};

/// Reports a word that already occurred in this part of the file; with `lenient` the later one is
/// used.
void check_once(Parser& parser, std::vector<std::string>& seen, std::string_view word);

/// Reads a whole ASF text. All its faults are in `diagnostics`; the result is valid only if there
/// are no errors.
/// \param source  UTF-8 without a byte order mark
AsfFile parse_asf(const text::Source& source, bool lenient, Diagnostics& diagnostics);

/// Reads the :bonedata section, after its keyword.
void parse_bones(Parser& parser, AsfFile& file);

/// Reads the :hierarchy section, after its keyword: sets the parents of the bones.
/// \returns  for each bone, whether a line names it as a child
std::vector<bool> parse_hierarchy(Parser& parser, AsfFile& file);

/// Reads three angles and, with `has_order`, the order of their axes.
bool parse_orientation(Parser& parser, Orientation& orientation, bool has_order);

/// Reads the order of three axes: "XYZ", "zyx".
bool parse_axis_order(Parser& parser, AxisOrder& order);

/// Reads `count` finite numbers, over any number of lines.
bool parse_numbers(Parser& parser, const std::string& what, double* out, std::size_t count);

/// Reads the words of a `dof` or an `order` line, up to the first other word.
std::vector<DofWord> parse_dofs(Parser& parser);

/// Reads the header of an AMC text up to the first frame.
AmcHeader parse_amc_header(Parser& parser);

/// Reads the frames.
/// \param bones  every bone that has values, with its name in the skeleton
/// \param skeleton_name  the name of the skeleton in messages
AmcBody parse_amc_body(Parser& parser, const std::vector<BoneColumns>& bones,
                       const std::string& skeleton_name);

}  // namespace kinefile::acclaim
