// SPDX-License-Identifier: MIT
#include "base/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

#include "kinefile/threads.hpp"
#include "support/threads.hpp"

namespace kinefile {
namespace {

using test::kThreadCounts;
using test::Threads;

TEST(Parallel, ThereIsAThread) { EXPECT_GE(max_threads(), 1u); }

TEST(Parallel, EveryIndexIsWorkedOnOnce) {
  for (const std::size_t count : kThreadCounts) {
    const Threads threads(count);
    std::vector<std::atomic<int>> calls(1000);
    for_each_index(calls.size(), [&](std::size_t i) { ++calls[i]; });
    for (const auto& number : calls) EXPECT_EQ(number, 1);
  }
}

TEST(Parallel, WorkWithinWorkIsDoneThere) {
  const Threads threads(7);
  std::atomic<int> num_calls{0};
  for_each_index(20, [&](std::size_t) {
    EXPECT_EQ(slots_for_threads(), 1u);
    for_each_index(20, [&](std::size_t) { ++num_calls; });
  });
  EXPECT_EQ(num_calls, 400);
}

TEST(Parallel, AnExceptionReachesTheCaller) {
  for (const std::size_t count : kThreadCounts) {
    const Threads threads(count);
    const auto throws = [](std::size_t i) {
      if (i == 3) throw std::runtime_error("three");
    };
    EXPECT_THROW(for_each_index(100, throws), std::runtime_error);
    const auto use = [](std::size_t, std::size_t) { return true; };
    const auto make = [&](std::size_t i, std::size_t) { throws(i); };
    EXPECT_THROW(make_in_order(100, 4, make, use), std::runtime_error);
    const auto use_throws = [&](std::size_t i, std::size_t) {
      throws(i);
      return true;
    };
    EXPECT_THROW(make_in_order(
                     100, 4, [](std::size_t, std::size_t) {}, use_throws),
                 std::runtime_error);
  }
}

TEST(Parallel, PartsAreUsedInOrderAndFewExist) {
  constexpr std::size_t kSlots = 3;
  for (const std::size_t count : kThreadCounts) {
    const Threads threads(count);
    std::vector<std::size_t> slots(kSlots);
    std::vector<std::size_t> used;
    std::atomic<std::size_t> num_alive{0};
    const auto make = [&](std::size_t i, std::size_t slot) {
      EXPECT_LE(++num_alive, kSlots);
      slots[slot] = i * i;
    };
    const auto use = [&](std::size_t i, std::size_t slot) {
      EXPECT_EQ(slots[slot], i * i);
      used.push_back(i);
      --num_alive;
      return true;
    };
    EXPECT_TRUE(make_in_order(500, kSlots, make, use));
    ASSERT_EQ(used.size(), 500u);
    for (std::size_t i = 0; i < used.size(); ++i) EXPECT_EQ(used[i], i);
  }
}

TEST(Parallel, UseCanStop) {
  for (const std::size_t count : kThreadCounts) {
    const Threads threads(count);
    std::size_t num_used = 0;
    const auto make = [](std::size_t, std::size_t) {};
    const auto use = [&](std::size_t i, std::size_t) {
      ++num_used;
      return i < 9;
    };
    EXPECT_FALSE(make_in_order(100, 4, make, use));
    EXPECT_EQ(num_used, 10u);
  }
}

}  // namespace
}  // namespace kinefile
