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
  std::optional<int> decimals;
  bool may_replace = false;
  shape::ChannelOptions channels;  ///< that the motion is to have
  WriteOptions format;             ///< what single formats can be told
  std::string form;                ///< of a body motion: links, joints, both; empty: as it is
  std::string joint_map;           ///< a file: which joint a robot's joints follow
  std::string robot;               ///< --robot
  std::string flow_format;         ///< of a flow: word_n or v1r4; empty: as it is
  std::string up;                  ///< y, z or as-is; empty: what the format has
};

/// Gives a command the options of `Writing` but for the output itself, which some take by place.
void add_writing_options(CLI::App& command, Writing& writing);

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
