// SPDX-License-Identifier: MIT
#include "kinefile/batch.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

#include "kinefile/process.hpp"
#include "support/support.hpp"
#include "support/threads.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

using test::kThreadCounts;

TEST(Batch, ResultsAreUsedInTheOrderOfTheInputs) {
  for (const std::size_t count : kThreadCounts) {
    const test::Threads threads(count);
    std::vector<std::size_t> used;
    const bool is_whole = for_each_input<std::string>(
        {.num_inputs = 300}, [](std::size_t i) { return std::to_string(i); },
        [&used](std::size_t i, std::string&& text) {
          EXPECT_EQ(text, std::to_string(i));
          used.push_back(i);
          return true;
        });
    EXPECT_TRUE(is_whole);
    ASSERT_EQ(used.size(), 300u);
    for (std::size_t i = 0; i < used.size(); ++i) EXPECT_EQ(used[i], i);
  }
}

TEST(Batch, FewResultsExistAtATime) {
  const test::Threads threads(7);
  std::atomic<std::size_t> num_held{0};
  std::atomic<std::size_t> most{0};
  for_each_input<int>(
      {.num_inputs = 500},
      [&](std::size_t) {
        const std::size_t held = ++num_held;
        std::size_t known = most;
        while (held > known && !most.compare_exchange_weak(known, held)) {
        }
        return 0;
      },
      [&](std::size_t, int) {
        --num_held;
        return true;
      });
  EXPECT_EQ(num_held, 0u);
  EXPECT_LE(most, num_batch_slots());
}

TEST(Batch, AnInputThatIsAloneHasNoOtherBesideIt) {
  for (const std::size_t count : kThreadCounts) {
    const test::Threads threads(count);
    std::atomic<int> num_at_work{0};
    std::vector<std::size_t> used;
    const auto is_alone = [](std::size_t i) { return i % 10 == 3 || i == 4 || i == 49; };
    for_each_input<int>(
        {.num_inputs = 50, .is_alone = is_alone},
        [&](std::size_t i) {
          const int at_work = ++num_at_work;
          if (is_alone(i)) {
            EXPECT_EQ(at_work, 1);
            EXPECT_EQ(used.size(), i);  // and all before it are done with
          }
          --num_at_work;
          return 0;
        },
        [&](std::size_t i, int) {
          used.push_back(i);
          return true;
        });
    EXPECT_EQ(used.size(), 50u);
  }
}

TEST(Batch, StopsWhereTheUserOfResultsSaysSo) {
  for (const std::size_t count : kThreadCounts) {
    const test::Threads threads(count);
    std::size_t num_used = 0;
    std::atomic<std::size_t> num_made{0};
    const bool is_whole = for_each_input<int>(
        {.num_inputs = 1000, .is_alone = [](std::size_t i) { return i == 500; }},
        [&num_made](std::size_t) {
          ++num_made;
          return 0;
        },
        [&num_used](std::size_t i, int) {
          ++num_used;
          return i < 20;
        });
    EXPECT_FALSE(is_whole);
    EXPECT_EQ(num_used, 21u);
    EXPECT_LE(num_made, 21u + num_batch_slots());
  }
}

/// The files that a job on a walk writes: each walk is another, and so is what is done to it.
std::vector<MemoryFile> written_by_job(std::size_t i) {
  constexpr const char* kTargets[] = {"y.bvh", "y.amc", "y.csv", "y.json", "y.seq"};
  constexpr const char* kOperations[] = {"mirror", "trim=5:", "scale=2", "speed=1.5"};
  examples::WalkOptions walk;
  walk.num_frames = 20 + i % 13;
  const std::string bytes = test::write_to_string({examples::make_walk(walk), "bvh", {}}, "bvh");
  Job job;
  job.source = "walk.bvh";
  job.bytes = bytes;
  job.operations = parse_operations(std::vector<std::string>{kOperations[i % 4]}).value();
  job.target = kTargets[i % 5];
  auto files = std::make_shared<std::vector<MemoryFile>>();
  const Report report = process(job, files_in_memory(files));
  EXPECT_FALSE(report.error) << report.error->message;
  return *files;
}

TEST(Batch, JobsOnSevenThreadsWriteTheSameBytesAsOnOne) {
  const auto bytes_on = [](std::size_t num_threads) {
    const test::Threads threads(num_threads);
    std::string all;
    for_each_input<std::vector<MemoryFile>>({.num_inputs = 30}, written_by_job,
                                            [&all](std::size_t, std::vector<MemoryFile>&& files) {
                                              for (const MemoryFile& file : files) {
                                                all += file.name + "\n" + file.bytes;
                                              }
                                              return true;
                                            });
    return all;
  };
  const std::string alone = bytes_on(1);
  EXPECT_GT(alone.size(), 30u * 1000);
  EXPECT_EQ(bytes_on(7), alone);
}

TEST(Process, ChangesTheDocumentBeforeTheOperationsDo) {
  const std::string bytes =
      test::write_to_string({examples::make_walk({.num_frames = 40}), "bvh", {}}, "bvh");
  Job job;
  job.source = "walk.bvh";
  job.bytes = bytes;
  job.operations = parse_operations(std::vector<std::string>{"trim=:10"}).value();
  job.change = [](Document& document, Diagnostics& diagnostics) -> Result<void> {
    EXPECT_EQ(std::get<Motion>(document.content).clip.num_frames, 40u);
    diagnostics.add(Severity::Warning, "TST001", "changed");
    return {};
  };
  job.target = "y.bvh";
  auto files = std::make_shared<std::vector<MemoryFile>>();
  const Report done = process(job, files_in_memory(files));
  EXPECT_FALSE(done.error);
  EXPECT_EQ(done.num_frames, 10u);
  EXPECT_EQ(done.diagnostics.count(Severity::Warning), 1u);
  job.strict = true;
  EXPECT_TRUE(process(job, files_in_memory(files)).error);
  job.change = [](Document&, Diagnostics&) -> Result<void> {
    return fail(ErrorKind::Usage, "TST002", "refused");
  };
  EXPECT_EQ(process(job, files_in_memory(files)).error->code, "TST002");
}

}  // namespace
}  // namespace kinefile
