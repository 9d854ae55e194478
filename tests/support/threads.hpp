// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "kinefile/threads.hpp"

namespace kinefile::test {

/// Chooses the number of threads as long as it lives.
class Threads {
 public:
  explicit Threads(std::size_t count) : before_(max_threads()) { set_max_threads(count); }
  ~Threads() { set_max_threads(before_); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

 private:
  std::size_t before_;
};

/// Numbers of threads that give the same results.
inline constexpr std::size_t kThreadCounts[] = {1, 2, 7};

}  // namespace kinefile::test
