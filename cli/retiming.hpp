// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "command.hpp"
#include "writing.hpp"

namespace kinefile::cli {

/// Options of every command that shows a motion at other times.
struct Retiming {
  std::string rotation = "slerp";
  bool has_antialias = false;
  bool prints_table = false;
  Writing writing;
  Reading reading;
};

/// How rotations are to be found, and so on.
retime::RetimeOptions retime_options(const Retiming& retiming);

/// Gives a command the options of `Retiming`; `--table` if it may print its map.
void add_retiming_options(CLI::App& command, Retiming& retiming, bool has_table);

/// Reads a motion or a body motion; reports why there is none.
std::optional<Document> load_motion(const std::string& path, const Reading& reading,
                                    const Globals& globals, int& exit_code);

/// Ends a command: prints the map, or shows the motion by it and writes that. Reports errors.
int finish_retiming(Result<retime::TimeMap> map, Document&& document, const std::string& path,
                    const Retiming& retiming, Diagnostics& diagnostics, const Globals& globals);

}  // namespace kinefile::cli
