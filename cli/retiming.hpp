// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "command.hpp"
#include "many.hpp"
#include "writing.hpp"

namespace kinefile::cli {

/// Options of every command that shows a motion at other times.
struct Retiming {
  retime::RetimeOptions options;  ///< set through `retime::retime_options`
  bool prints_table = false;
  Many many;
  Writing writing;
  Reading reading;
};

/// How the motion is shown at other times, with the leniency of reading.
retime::RetimeOptions options_of(const Retiming& retiming);

/// Adds the options of `Retiming` to a command; with `--table` if it can print its map, with
/// `--out-dir` if it takes many files.
void add_retiming_options(CLI::App& command, Retiming& retiming, bool has_table, bool takes_many);

/// Adds the positional argument of a command that takes one file, or many with --out-dir.
void add_retiming_inputs(CLI::App& command, std::string& file, Retiming& retiming,
                         const Globals& globals);

/// Runs a command on many files.
/// \param retime            changes the motion of a document
/// \param retime_in_blocks  one that is too large for memory; null: it has to be read whole
int retime_many(
    const Retiming& retiming,
    const std::function<Result<void>(Document& document, Diagnostics& diagnostics)>& retime,
    const ChangeLong& retime_in_blocks, const Globals& globals);

/// Reads a motion or a body motion; reports the error if there is none.
std::optional<Document> load_motion(const std::string& path, const Reading& reading,
                                    const Globals& globals, int& exit_code);

/// Ends a command: prints the map, or applies it to the motion and writes the result. Reports
/// errors.
int finish_retiming(Result<retime::TimeMap> map, Document&& document, const std::string& path,
                    const Retiming& retiming, Diagnostics& diagnostics, const Globals& globals);

}  // namespace kinefile::cli
