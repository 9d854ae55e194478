// SPDX-License-Identifier: MIT
#include "base/parallel.hpp"

#include "kinefile/threads.hpp"

#if defined(__EMSCRIPTEN__)

// The browser's build has no threads.
namespace kinefile {

std::size_t max_threads() { return 1; }
void set_max_threads(std::size_t) {}
std::size_t free_threads() { return 1; }
std::size_t slots_for_threads() { return 1; }

void for_each_index(std::size_t count, const std::function<void(std::size_t)>& work) {
  for (std::size_t i = 0; i < count; ++i) work(i);
}

void for_each_group(std::size_t count, std::size_t,
                    const std::function<void(std::size_t, std::size_t)>& work) {
  work(0, count);
}

bool make_in_order(std::size_t count, std::size_t,
                   const std::function<void(std::size_t, std::size_t)>& make,
                   const std::function<bool(std::size_t, std::size_t)>& use) {
  for (std::size_t i = 0; i < count; ++i) {
    make(i, 0);
    if (!use(i, 0)) return false;
  }
  return true;
}

}  // namespace kinefile

#else

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sched.h>
#endif

namespace kinefile {
namespace {

std::atomic<std::size_t> chosen_threads{0};

/// Whether this thread does a part of some work already; then it does all of what is within.
thread_local bool is_at_work = false;

std::size_t num_cores() {
#if defined(__linux__)
  cpu_set_t cores;
  if (::sched_getaffinity(0, sizeof cores, &cores) == 0) {
    return static_cast<std::size_t>(CPU_COUNT(&cores));
  }
#endif
  return std::max<std::size_t>(std::thread::hardware_concurrency(), 1);
}

/// Runs a function on several threads at once, this one included.
/// \param function  must not throw
void run_on_threads(std::size_t num_threads, const std::function<void()>& function) {
  std::vector<std::thread> threads;
  const auto run = [&function] {
    const bool was_at_work = std::exchange(is_at_work, true);
    function();
    is_at_work = was_at_work;
  };
  try {
    threads.reserve(num_threads);
    while (threads.size() + 1 < num_threads) threads.emplace_back(run);
  } catch (const std::exception&) {
    // The system has no more threads or memory: those that are there do the work.
  }
  run();
  for (std::thread& thread : threads) thread.join();
}

std::size_t threads_for(std::size_t count) { return std::min(count, free_threads()); }

/// The state of `make_in_order`, all of it under `mutex`.
struct Line {
  std::size_t count = 0;
  std::size_t num_slots = 0;
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<char> is_made;  ///< by slot
  std::size_t num_taken = 0;
  std::size_t num_used = 0;
  bool is_stopped = false;
  std::exception_ptr failure;  ///< the first

  bool can_take() const { return num_taken < count && num_taken < num_used + num_slots; }
  bool is_next_made() const { return is_made[num_used % num_slots] != 0; }
  bool is_over() const { return is_stopped || num_used == count; }
};

/// Makes the next part. The lock is held before and behind.
void make_next(Line& line, std::unique_lock<std::mutex>& lock,
               const std::function<void(std::size_t, std::size_t)>& make) {
  const std::size_t part = line.num_taken++;
  lock.unlock();
  std::exception_ptr thrown;
  try {
    make(part, part % line.num_slots);
  } catch (...) {
    thrown = std::current_exception();
  }
  lock.lock();
  if (thrown) {
    if (!line.failure) line.failure = thrown;
    line.is_stopped = true;
  } else {
    line.is_made[part % line.num_slots] = 1;
  }
  line.changed.notify_all();
}

/// Uses the next part, which is made. The lock is held before and behind.
void use_next(Line& line, std::unique_lock<std::mutex>& lock,
              const std::function<bool(std::size_t, std::size_t)>& use) {
  const std::size_t part = line.num_used;
  lock.unlock();
  bool goes_on = false;
  std::exception_ptr thrown;
  try {
    goes_on = use(part, part % line.num_slots);
  } catch (...) {
    thrown = std::current_exception();
  }
  lock.lock();
  if (thrown && !line.failure) line.failure = thrown;
  line.is_made[part % line.num_slots] = 0;
  if (goes_on) ++line.num_used;
  line.is_stopped |= !goes_on;
  line.changed.notify_all();
}

}  // namespace

std::size_t max_threads() {
  const std::size_t chosen = chosen_threads.load(std::memory_order_relaxed);
  if (chosen != 0) return chosen;
  static const std::size_t cores = num_cores();
  return cores;
}

void set_max_threads(std::size_t count) { chosen_threads.store(count, std::memory_order_relaxed); }

std::size_t free_threads() { return is_at_work ? 1 : max_threads(); }

std::size_t slots_for_threads() { return is_at_work ? 1 : 2 * max_threads(); }

void for_each_index(std::size_t count, const std::function<void(std::size_t)>& work) {
  const std::size_t num_threads = threads_for(count);
  if (num_threads <= 1) {
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  run_on_threads(num_threads, [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) work(i);
    } catch (...) {
      next = count;
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  });
  if (failure) std::rethrow_exception(failure);
}

void for_each_group(std::size_t count, std::size_t num_numbers,
                    const std::function<void(std::size_t, std::size_t)>& work) {
  constexpr std::size_t kManyNumbers = std::size_t{1} << 15;
  const std::size_t num_groups = num_numbers < kManyNumbers ? 1 : threads_for(count);
  if (num_groups <= 1) return work(0, count);
  for_each_index(num_groups, [&](std::size_t group) {
    work(count * group / num_groups, count * (group + 1) / num_groups);
  });
}

bool make_in_order(std::size_t count, std::size_t num_slots,
                   const std::function<void(std::size_t, std::size_t)>& make,
                   const std::function<bool(std::size_t, std::size_t)>& use) {
  const std::size_t num_threads = threads_for(std::min(count, num_slots));
  if (num_threads <= 1) {
    for (std::size_t i = 0; i < count; ++i) {
      make(i, 0);
      if (!use(i, 0)) return false;
    }
    return true;
  }
  Line line;
  line.count = count;
  line.num_slots = num_slots;
  line.is_made.resize(num_slots);
  const std::thread::id user = std::this_thread::get_id();
  run_on_threads(num_threads, [&] {
    const bool is_user = std::this_thread::get_id() == user;
    std::unique_lock lock(line.mutex);
    while (!line.is_over()) {
      if (is_user && line.is_next_made()) {
        use_next(line, lock, use);
      } else if (line.can_take()) {
        make_next(line, lock, make);
      } else if (!is_user && line.num_taken == count) {
        return;
      } else {
        line.changed.wait(lock);
      }
    }
  });
  if (line.failure) std::rethrow_exception(line.failure);
  return !line.is_stopped;
}

}  // namespace kinefile

#endif  // __EMSCRIPTEN__
