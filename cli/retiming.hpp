// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "command.hpp"
#include "writing.hpp"

namespace kinefile::cli {

/// Options of every command that shows a motion at other times.
struct Retiming {
  retime::RetimeOptions options;  ///< set through `retime::retime_options`
  bool prints_table = false;
  Writing writing;
  Reading reading;
};

/// How the motion is shown at other times, with the leniency of reading.
retime::RetimeOptions options_of(const Retiming& retiming);

/// Adds the options of `Retiming` to a command; with `--table` if it can print its map.
void add_retiming_options(CLI::App& command, Retiming& retiming, bool has_table);

/// Reads a motion or a body motion; reports the error if there is none.
std::optional<Document> load_motion(const std::string& path, const Reading& reading,
                                    const Globals& globals, int& exit_code);

/// Ends a command: prints the map, or applies it to the motion and writes the result. Reports
/// errors.
int finish_retiming(Result<retime::TimeMap> map, Document&& document, const std::string& path,
                    const Retiming& retiming, Diagnostics& diagnostics, const Globals& globals);

}  // namespace kinefile::cli
