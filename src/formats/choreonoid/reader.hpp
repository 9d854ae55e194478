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

/// What all parts of the reader work with.
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
  /// An error, or with --lenient a warning that says what is done instead. True for the latter.
  bool repair(const char* code, std::string message, std::string_view repair, const char* at) const;
  /// A warning that Choreonoid does not take what is read here.
  void warn_rejected(std::string_view why, const char* at) const;
};

/// Reads a node as a number: decimal or hexadecimal; nan, inf and what is too large for a double
/// with a warning. Nothing after an error.
std::optional<double> read_number(const Reader& reader, const text::yaml::Node& node);

/// Reads a file. Errors are in the reader's diagnostics.
SeqFile parse(const Reader& reader);

/// Reads the frames of a component whose other keys are known.
void parse_frames(const Reader& reader, const text::yaml::Node& frames, SeqComponent& component);

/// Makes the frames that the file gave with their times a steady sequence.
void resample_timed(const Reader& reader, SeqComponent& component);

/// Tells of times that frames cannot keep: each is to be above the one before.
void check_kept_times(const Reader& reader, const SeqComponent& component);

}  // namespace kinefile::choreonoid
