// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <array>
#include <chrono>
#include <csignal>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/result.hpp"

namespace kinefile::cli {

/// When to stop waiting.
using Deadline = std::chrono::steady_clock::time_point;

/// A folder of our own for temporary files, which no other user can read. It is removed with all
/// that is in it when the object dies.
class TemporaryFolder {
 public:
  /// \errors IO003 if it cannot be made
  static Result<TemporaryFolder> create();

  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  TemporaryFolder(TemporaryFolder&& other) noexcept;
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;
  ~TemporaryFolder();

  const std::string& path() const { return path_; }

 private:
  explicit TemporaryFolder(std::string path);
  std::string path_;
};

/// While it lives, signals that ask the program to end (SIGINT, SIGTERM, SIGHUP) only end
/// `BrowserProcess::receive` with an error, so that everything is cleaned up.
class HeldSignals {
 public:
  HeldSignals();
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  HeldSignals(HeldSignals&&) = delete;
  HeldSignals& operator=(HeldSignals&&) = delete;
  ~HeldSignals();

  /// Waits until there is something to read from a descriptor; the signals come only meanwhile.
  /// \returns as pselect
  static int wait_for_bytes(int descriptor, Deadline deadline);

 private:
  static constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};
  sigset_t old_mask_;
  std::array<struct sigaction, kSignals.size()> old_actions_;
};

/// A browser that is driven by messages over two pipes, its descriptors 3 and 4. It and the
/// processes that it starts are killed, and waited for, when the object dies. Its own output is not
/// shown.
class BrowserProcess {
 public:
  /// \param arguments  without the program's name
  /// \param temporary  the folder for the browser's own temporary files
  /// \errors PAG003 (Io) if it cannot be started
  static Result<BrowserProcess> start(const std::string& program,
                                      const std::vector<std::string>& arguments,
                                      const std::string& temporary);

  BrowserProcess(const BrowserProcess&) = delete;
  BrowserProcess& operator=(const BrowserProcess&) = delete;
  BrowserProcess(BrowserProcess&& other) noexcept;
  BrowserProcess& operator=(BrowserProcess&&) = delete;
  ~BrowserProcess();

  /// Sends a message, which is much shorter than a pipe's buffer.
  /// \errors PAG003 (Io) if the browser has ended
  Result<void> send(std::string_view message);

  /// The next message.
  /// \errors PAG003 (Io) if the browser has ended, the deadline has passed, or a signal came
  Result<std::string> receive(Deadline deadline);

 private:
  BrowserProcess(pid_t process, int to_browser, int from_browser);
  Result<void> read_more(Deadline deadline);

  pid_t process_;
  int to_browser_;
  int from_browser_;
  std::string received_;  ///< what was read and is not yet a whole message
};

}  // namespace kinefile::cli
