// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/kinefile.hpp"

namespace kinefile::cli {

/// Makes SIGINT, SIGTERM and SIGHUP end the program without temporary files that stay: at once
/// while there are none, otherwise as soon as what is written has failed and they are removed. One
/// that is ignored, as nohup does with SIGHUP, stays so. A file that grows beyond its limit
/// (SIGXFSZ), and a reader that stops early (SIGPIPE), are failed writes.
void handle_signals();

/// Notes a signal: what is written stops. May be called by a handler.
void note_signal(int number);

/// The signal that was noted; 0 if none was.
int noted_signal();

/// Ends the program by the signal that was noted, if one was.
void end_by_noted_signal();

/// Options of output that a signal stops.
OutputOptions output_options(bool may_replace);

}  // namespace kinefile::cli
