// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "command.hpp"

namespace kinefile::cli {

enum class FileResult { Written, UpToDate, Failed };

/// What came of one of many files.
struct SummaryLine {
  std::string input;
  FileResult result = FileResult::Written;
  std::vector<std::string> outputs;
  std::string code;     ///< of the error; empty: there is none
  std::string message;  ///< of the error
};

/// What came of many files, in their order.
struct Summary {
  std::vector<SummaryLine> lines;
  int worst = kDone;  ///< the worst exit code of a file
};

/// Prints the summary for people on stderr: the counts, and a table of the files that failed.
void print_summary(const Summary& summary);

/// Prints the summary on stdout.
void print_json_summary(const Summary& summary);

/// The exit code of all: of a run in which no file succeeded it is the worst.
int exit_code_of(const Summary& summary);

}  // namespace kinefile::cli
