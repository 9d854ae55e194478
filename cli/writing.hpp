// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "command.hpp"

namespace kinefile::cli {

/// Options of every command that writes a document.
struct Writing {
  std::string out;  ///< "-" is standard output
  std::string to;   ///< the name of a format; empty: the output's name tells
  bool may_replace = false;
  WriteOptions format;    ///< what the formats' tables of options say
  AdaptOptions adapting;  ///< what the table of `adapt_options` says
  std::string joint_map;  ///< a file: which joint a robot's joints follow
  std::string robot;      ///< a file: the robot that a motion goes onto
};

/// Gives a command the options of `Writing` but for the output itself, which some take by place.
/// Options that are of reading, too, are left to `add_reading_options`.
void add_writing_options(CLI::App& command, Writing& writing);

/// Gives a command the options of `adapt`, and those that formats have for reading and writing
/// alike, which then are of both: call it before the options of writing and reading are added.
void add_adapting_options(CLI::App& command, Writing& writing, Reading& reading);

/// The format that the options ask for, or null.
const Format* output_format(const Writing& writing);

/// Reports that the output shows no format. Returns kUsage.
int no_output_format(const Writing& writing, const Globals& globals);

/// The format of a command's output that may be left out: then it is standard output, in the
/// format of the input. Null if it shows no format.
const Format* output_format(const Writing& writing, const Document& input);

/// Ends a command that makes a document out of a file: brings it into the format's form and writes
/// it, unless making it failed, and
/// reports on stderr what was noticed on the way. Returns the exit code.
/// \param made         how making the document went
/// \param source       the file that errors without a place are told of
/// \param reading      how that was read; a skeleton that it names is the output's, too
/// \param diagnostics  what was noticed while it was made
int write_document(Result<void> made, Document&& document, const Format& format,
                   const Writing& writing, const std::string& source, const Reading& reading,
                   Diagnostics& diagnostics, const Globals& globals);

}  // namespace kinefile::cli
