// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>

#include "command.hpp"

namespace kinefile::cli {

/// Prints diagnostics in the order of their places: of one code the first 20, then a count. Notes
/// and warnings are left out if the user wants it quiet.
void print_diagnostics(std::FILE* stream, const Diagnostics& diagnostics, const Globals& globals);

/// Prints an error that is not among diagnostics, on stderr.
void print_error(const Error& error, const Globals& globals);

/// Prints data on stdout. A fault is noticed by `finish_output`.
void print_data(std::string_view text);

/// Sees that all data has been written, and reports it if not: returns `exit_code`, or kIo.
int finish_output(int exit_code, const Globals& globals);

/// The program's exit code for an error.
ExitCode exit_code_of(const Error& error);

/// The worse of two exit codes: a fault of the machine before one of the input.
int worse(int a, int b);

}  // namespace kinefile::cli
