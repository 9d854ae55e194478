// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "report.hpp"

namespace kinefile::cli {
namespace {

constexpr std::chrono::milliseconds kBeforeTheFirst{1000};
constexpr std::chrono::milliseconds kBetween{100};

}  // namespace

Progress::Progress(std::size_t num_files, const Globals& globals)
    : num_files_(num_files),
      is_shown_(!globals.is_quiet && isatty(STDERR_FILENO) == 1),
      next_(Clock::now() + kBeforeTheFirst) {}

void Progress::show(std::size_t num_done) {
  constexpr std::size_t kWidth = 30;
  if (!is_shown_ || Clock::now() < next_) return;
  next_ = Clock::now() + kBetween;
  const std::size_t num_marks = kWidth * num_done / num_files_;
  show_status_line(fmt::format("[{:<{}}] {} of {} files", std::string(num_marks, '#'), kWidth,
                               num_done, num_files_));
}

void Progress::clear() { show_status_line({}); }

}  // namespace kinefile::cli
