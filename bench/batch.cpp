// SPDX-License-Identifier: MIT
#include "batch.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "report.hpp"
#include "subject.hpp"
#include "walk.hpp"

namespace kinefile::bench {
namespace {

constexpr std::size_t kNumFiles = 500;
constexpr std::size_t kNumFrames = 175;  // some 100 KB as BVH

std::string name_of_take(std::size_t i) {
  return fmt::format("{}/takes/{}.bvh", subject().folder, i);
}

/// Writes the files, once.
void make_takes() {
  static bool is_made = false;
  if (is_made) return;
  is_made = true;
  std::filesystem::create_directories(subject().folder + "/takes");
  std::filesystem::create_directories(subject().folder + "/tables");
  Document document;
  document.content = examples::make_walk({.num_frames = kNumFrames});
  Diagnostics diagnostics;
  for (std::size_t i = 0; i < kNumFiles; ++i) {
    const auto written =
        write_file(name_of_take(i), document, *find_format("bvh"), {}, {}, diagnostics);
    if (!written) std::exit(1);
  }
}

/// Converts all of them to tables, as the command does.
void convert_takes(benchmark::State& state, std::size_t num_threads) {
  make_takes();
  set_max_threads(num_threads);
  for (auto _ : state) {
    const bool is_whole = for_each_input<Report>(
        {.num_inputs = kNumFiles},
        [](std::size_t i) {
          Job job;
          job.source = name_of_take(i);
          job.target = fmt::format("{}/tables/{}.csv", subject().folder, i);
          return process(job, files_on_disk({.may_replace = true}));
        },
        [](std::size_t, Report&& report) { return !report.error; });
    if (!is_whole) state.SkipWithError("not converted");
  }
  set_max_threads(0);
}

}  // namespace

void add_batch() {
  measure(
      "batch/one_job", [](benchmark::State& state) { convert_takes(state, 1); }, Time::Clock);
  measure(
      "batch/two_jobs", [](benchmark::State& state) { convert_takes(state, 2); }, Time::Clock);
  compare("500 files of 100 KB, 2 jobs against 1 job", "batch/two_jobs", "batch/one_job");
}

}  // namespace kinefile::bench
