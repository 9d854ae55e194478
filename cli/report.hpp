// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include "command.hpp"

namespace kinefile::cli {

/// Prints diagnostics in the order of their places: the first 20 of each code, then a count. With
/// --quiet, notes and warnings are not printed.
/// \param stream  STDOUT_FILENO or STDERR_FILENO
void print_diagnostics(int stream, const Diagnostics& diagnostics, const Globals& globals);

/// Prints an error that is not among diagnostics, on stderr.
void print_error(const Error& error, const Globals& globals);

/// Prints the error that ended a command, unless it is among the diagnostics, which were printed.
/// \param file  the source of an error without a place
/// \returns the program's exit code
int print_failure(Error error, const Diagnostics& diagnostics, const std::string& file,
                  const Globals& globals);

/// Prints a message for people on stderr, as `print_lines`. A full or closed stream is no fault.
void print_message(std::string_view text);

/// Shows a line on stderr, which is a terminal, instead of the last one, until something else is
/// printed; an empty one removes it.
void show_status_line(const std::string& text);

/// Prints a text for people on stdout: of its control characters only line ends stay as they are.
void print_lines(std::string_view text);

/// Prints data on stdout, exactly. `finish_output` detects faults.
void print_data(std::string_view text);

/// Checks that all data has been written, and reports a fault.
/// \returns `exit_code`, or kIo after a fault
int finish_output(int exit_code, const Globals& globals);

/// The program's exit code for an error.
ExitCode exit_code_of(const Error& error);

/// The worse of two exit codes: a fault of the machine is worse than one of the input.
int worse(int a, int b);

}  // namespace kinefile::cli
