// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "command.hpp"

namespace kinefile::cli {

/// Options of every command that writes a document.
struct Writing {
  std::string out;  ///< "-" is standard output
  std::string to;   ///< the name of a format; empty: detected from the output's name
  bool may_replace = false;
  WriteOptions format;    ///< set through the formats' tables of options
  AdaptOptions adapting;  ///< set through the table of `adapt_options`
  std::string joint_map;  ///< a file that specifies which joint each robot joint follows
  std::string robot;      ///< a file with the robot that a motion is mapped to
};

/// Adds the options of `Writing` to a command, except the output itself, which some commands have
/// as a positional argument. Options that are also for reading are added by `add_reading_options`.
void add_writing_options(CLI::App& command, Writing& writing);

/// Adds the options of `adapt` to a command, and those that formats have for both reading and
/// writing, which then apply to both. Call it before the options of writing and reading are added.
void add_adapting_options(CLI::App& command, Writing& writing, Reading& reading);

/// The format that the options and the output's name alone ask for, or null.
const Format* output_format(const Writing& writing);

/// The first of all formats that is as wanted, or null.
const Format* first_format(bool (*is_wanted)(const Format&));

/// Reports that the format of the output is unknown.
/// \returns kUsage
int no_output_format(const Writing& writing, const Globals& globals);

/// The format of the output of a document: the one that the options ask for; otherwise the input's
/// own on standard output and under a name with the input's extension (see `format_of_output`);
/// otherwise the one of the output's name. Null if the format is unknown.
/// \param source  the name of the input
const Format* output_format(const Writing& writing, const std::string& source,
                            const Document& input);

/// The options of `adapt`, with the files that they name.
/// \param reading  must outlive them
/// \errors IO001 if the joint map cannot be read, those of `parse_joint_map`
Result<AdaptOptions> adapting_options(const Writing& writing, const Reading& reading,
                                      Diagnostics& diagnostics);

/// Ends a command that makes a document from a file: converts it for the format and writes it,
/// unless making it failed, and reports all diagnostics on stderr.
/// \returns the exit code
/// \param made         the result of making the document
/// \param source       the file name for errors without a place
/// \param reading      how that was read; a skeleton that it names is also used for the output
/// \param diagnostics  the diagnostics from making it
int write_document(Result<void> made, Document&& document, const Format& format,
                   const Writing& writing, const std::string& source, const Reading& reading,
                   Diagnostics& diagnostics, const Globals& globals);

}  // namespace kinefile::cli
