// SPDX-License-Identifier: MIT
#include "kinefile/batch.hpp"

#include "base/parallel.hpp"

namespace kinefile {

std::size_t num_batch_slots() { return slots_for_threads(); }

bool run_batch(const Batch& batch, std::size_t num_slots,
               const std::function<void(std::size_t input, std::size_t slot)>& make,
               const std::function<bool(std::size_t input, std::size_t slot)>& use) {
  const auto is_alone = [&batch](std::size_t input) {
    return batch.is_alone && batch.is_alone(input);
  };
  std::size_t begin = 0;
  while (begin < batch.num_inputs) {
    if (is_alone(begin)) {
      make(begin, 0);
      if (!use(begin, 0)) return false;
      ++begin;
      continue;
    }
    std::size_t end = begin + 1;
    while (end < batch.num_inputs && !is_alone(end)) ++end;
    const bool has_gone_on = make_in_order(
        end - begin, num_slots,
        [&make, begin](std::size_t i, std::size_t slot) { make(begin + i, slot); },
        [&use, begin](std::size_t i, std::size_t slot) { return use(begin + i, slot); });
    if (!has_gone_on) return false;
    begin = end;
  }
  return true;
}

}  // namespace kinefile
