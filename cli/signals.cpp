// SPDX-License-Identifier: MIT
#include "signals.hpp"

#include <signal.h>

namespace kinefile::cli {
namespace {

// Handlers have no parameters but the number of the signal.
Cancellation cancellation;               // NOLINT(*-avoid-non-const-global-variables)
volatile sig_atomic_t number_noted = 0;  // NOLINT(*-avoid-non-const-global-variables)

void end_by(int number) {
  ::signal(number, SIG_DFL);
  ::raise(number);
}

void stop(int number) {
  note_signal(number);
  if (cancellation.num_temporary_files == 0) end_by(number);
}

}  // namespace

void handle_signals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    ::sigaction(number, nullptr, &action);
    if (action.sa_handler == SIG_IGN) continue;
    action.sa_handler = stop;
    action.sa_flags = 0;
    ::sigaction(number, &action, nullptr);
  }
  ::signal(SIGXFSZ, SIG_IGN);
  ::signal(SIGPIPE, SIG_IGN);
}

void note_signal(int number) {
  number_noted = number;
  cancellation.is_requested = true;
}

int noted_signal() { return number_noted; }

void end_by_noted_signal() {
  if (number_noted != 0) end_by(number_noted);
}

OutputOptions output_options(bool may_replace) { return {may_replace, &cancellation}; }

}  // namespace kinefile::cli
