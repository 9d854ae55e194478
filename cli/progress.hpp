// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>

#include "command.hpp"

namespace kinefile::cli {

/// A bar on stderr that shows how many of some files are done: on a terminal alone, and only after
/// a second. What is printed meanwhile takes its place.
class Progress {
 public:
  Progress(std::size_t num_files, const Globals& globals);

  /// Shows that so many are done, but only a few times a second.
  void show(std::size_t num_done);

  /// Removes the bar.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::size_t num_files_;
  bool is_shown_;  ///< whether there is a terminal
  Clock::time_point next_;
};

}  // namespace kinefile::cli
