// SPDX-License-Identifier: MIT
// The only place that starts threads.
#pragma once

#include <cstddef>
#include <functional>

namespace kinefile {

/// The browser's build has no threads, and no bytes for what would never run.
#ifdef __EMSCRIPTEN__
inline constexpr bool kHasThreads = false;
#else
inline constexpr bool kHasThreads = true;
#endif

/// Calls `work(i)` for each i below `count`, on up to `max_threads()` threads, and returns when all
/// calls have ended. Work within such work is done by its own thread alone. If calls throw, the
/// others are left out as far as possible, and one exception is thrown again here.
void for_each_index(std::size_t count, const std::function<void(std::size_t)>& work);

/// Calls `work(begin, end)` for groups of consecutive indices below `count`, on several threads if
/// there is much to do: a group for each of them, or one of all.
/// \param num_numbers  that are worked on for all indices together
void for_each_group(std::size_t count, std::size_t num_numbers,
                    const std::function<void(std::size_t, std::size_t)>& work);

/// Makes parts on up to `max_threads()` threads, and uses them in order on the calling thread:
/// `make(i, slot)`, later `use(i, slot)`, which returns false to stop. What belongs to a part lies
/// in its slot, which is used again: no more than `num_slots` parts exist at a time.
/// \returns  whether all parts were used
bool make_in_order(std::size_t count, std::size_t num_slots,
                   const std::function<void(std::size_t, std::size_t)>& make,
                   const std::function<bool(std::size_t, std::size_t)>& use);

/// How many threads would work on what is begun here, however much it is.
std::size_t free_threads();

/// The number of slots that keeps `max_threads()` threads at work.
std::size_t slots_for_threads();

}  // namespace kinefile
