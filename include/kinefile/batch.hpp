// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#pragma GCC visibility push(default)

namespace kinefile {

/// An input of this size or more is worked on alone: its own work is shared out among the threads,
/// and no other input takes memory meanwhile.
inline constexpr std::uint64_t kLargeInputBytes = std::uint64_t{32} << 20;

/// Many inputs, each of which is worked on by itself.
struct Batch {
  std::size_t num_inputs = 0;
  /// Whether an input is worked on alone; null: none is. See `kLargeInputBytes`.
  std::function<bool(std::size_t input)> is_alone = {};
};

/// The number of results that a batch holds at a time.
std::size_t num_batch_slots();

/// As `for_each_input`, for results that the caller keeps: that of an input lies in its slot, which
/// is used again.
/// \returns  whether all results were used
bool run_batch(const Batch& batch, std::size_t num_slots,
               const std::function<void(std::size_t input, std::size_t slot)>& make,
               const std::function<bool(std::size_t input, std::size_t slot)>& use);

/// Makes a result of each input on up to `max_threads()` threads, and uses the results on the
/// calling thread, in the order of the inputs. Few results exist at a time, however many inputs
/// there are. What is used does not depend on the number of threads.
/// \param make  called for several inputs at once
/// \param use   returns false to stop: results of inputs that follow are dropped
/// \returns     whether all results were used
template <class Outcome>
bool for_each_input(const Batch& batch, const std::function<Outcome(std::size_t input)>& make,
                    const std::function<bool(std::size_t input, Outcome&& outcome)>& use) {
  std::vector<std::optional<Outcome>> slots(num_batch_slots());
  return run_batch(
      batch, slots.size(),
      [&](std::size_t input, std::size_t slot) { slots[slot].emplace(make(input)); },
      [&](std::size_t input, std::size_t slot) {
        Outcome outcome = std::move(*slots[slot]);
        slots[slot].reset();
        return use(input, std::move(outcome));
      });
}

}  // namespace kinefile

#pragma GCC visibility pop
