// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "formats/choreonoid/syntax.hpp"
#include "kinefile/diagnostics.hpp"
#include "kinefile/format.hpp"
#include "text/source.hpp"
#include "text/yaml/tree.hpp"

namespace kinefile::choreonoid {

/// The data that all parts of the reader use.
struct Reader {
  const text::Source& source;
  text::yaml::Tree& tree;
  const kinefile::ReadOptions& options;
  Diagnostics& diagnostics;

  void tell(Severity severity, const char* code, std::string message, const char* at) const {
    text::report(source, diagnostics, severity, code, std::move(message), at);
  }
  void error(const char* code, std::string message, const char* at) const {
    tell(Severity::Error, code, std::move(message), at);
  }
  void warn(const char* code, std::string message, const char* at) const {
    tell(Severity::Warning, code, std::move(message), at);
  }
  /// Reports an error, or with --lenient a warning that describes the repair. True for the latter.
  bool repair(const char* code, std::string message, std::string_view repair, const char* at) const;
  /// A warning that Choreonoid does not accept this input.
  void warn_rejected(std::string_view why, const char* at) const;
};

/// Reads a node as a number: decimal or hexadecimal; nan, inf and numbers too large for a double
/// with a warning. Empty after an error.
std::optional<double> read_number(const Reader& reader, const text::yaml::Node& node);

/// Reads a file. Errors are in the reader's diagnostics.
SeqFile parse(const Reader& reader);

/// Reads the frames of a component whose other keys are known.
void parse_frames(const Reader& reader, const text::yaml::Node& frames, SeqComponent& component);

/// Converts frames with times to a steady rate.
void resample_timed(const Reader& reader, SeqComponent& component);

/// Reports times that frames cannot keep: each must be above the one before.
void check_kept_times(const Reader& reader, const SeqComponent& component);

}  // namespace kinefile::choreonoid
