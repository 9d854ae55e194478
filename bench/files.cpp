// SPDX-License-Identifier: MIT
#include "files.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef KINEFILE_HAS_ASSIMP
#include <assimp/cimport.h>
#endif

#include <cmath>
#include <filesystem>

#include "baselines.hpp"
#include "kinefile/threads.hpp"
#include "report.hpp"
#include "subject.hpp"

namespace kinefile::bench {
namespace {

/// Where a file of the subject is.
using PathOf = std::string Subject::*;

template <PathOf kPath>
void read_kinefile(benchmark::State& state) {
  const std::string& path = subject().*kPath;
  for (auto _ : state) benchmark::DoNotOptimize(read_or_exit(path));
}

/// \param kSum  adds up the numbers of a text
template <PathOf kPath, double (*kSum)(std::string_view)>
void read_baseline(benchmark::State& state) {
  for (auto _ : state) {
    const auto bytes = FileBytes::open(subject().*kPath);
    benchmark::DoNotOptimize(kSum(bytes->view()));
  }
}

double sum_of_bvh(std::string_view text) { return sum_with_fast_float(numbers_of_bvh(text)); }

/// By the clock, with a number of threads.
template <std::size_t kThreads>
void read_on_threads(benchmark::State& state) {
  set_max_threads(kThreads);
  for (auto _ : state) benchmark::DoNotOptimize(read_or_exit(subject().path));
  set_max_threads(1);
}

/// Reads block by block; the pass that counts the rows has been made.
void read_blocks(benchmark::State& state) {
  Diagnostics diagnostics;
  const auto motion = open_long_motion(subject().path, nullptr, 0, {}, diagnostics);
  for (auto _ : state) {
    const auto read = for_each_block(motion->frames, [](const FrameBlock& block) {
      benchmark::DoNotOptimize(block.rows.data());
      return true;
    });
    if (!read) state.SkipWithError("not read");
  }
}

#ifdef KINEFILE_HAS_ASSIMP
void read_assimp(benchmark::State& state) {
  for (auto _ : state) {
    const aiScene* const scene = aiImportFile(subject().path.c_str(), 0);
    if (scene == nullptr) state.SkipWithError("not read");
    aiReleaseImport(scene);
  }
}
#endif

void read_ifstream(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(sum_with_ifstream(subject().path));
}

void write_kinefile(benchmark::State& state) {
  Document document;
  document.content = subject().motion;
  Diagnostics diagnostics;
  std::size_t num_bytes = 0;
  const Sink sink = [&num_bytes](std::string_view piece) {
    num_bytes += piece.size();
    return true;
  };
  for (auto _ : state) {
    const auto written = find_format("bvh")->write(document, {}, sink, diagnostics);
    if (!written) state.SkipWithError("not written");
  }
  benchmark::DoNotOptimize(num_bytes);
}

/// The most memory that a process needed which did some work on a file, as a multiple of the file's
/// size.
template <class Work>
double peak_memory_ratio(const std::string& path, const Work& work) {
  const pid_t child = fork();
  if (child == 0) _exit(work() ? 0 : 1);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  if (status != 0) return std::nan("");
  return static_cast<double>(usage.ru_maxrss) * 1024 /
         static_cast<double>(std::filesystem::file_size(path));
}

bool reads_and_places() {
  const Document document = read_or_exit(subject().path);
  const Motion& motion = std::get<Motion>(document.content);
  return world_extent(motion.skeleton, motion.clip).min.allFinite();
}

bool reads_seq() {
  return std::holds_alternative<BodyMotion>(read_or_exit(subject().seq_path).content);
}

}  // namespace

void add_files() {
  measure("read/kinefile", read_kinefile<&Subject::path>);
  measure("read/bare_fast_float_loop", read_baseline<&Subject::path, sum_of_bvh>);
  measure("read_short/kinefile", read_kinefile<&Subject::short_path>);
  measure("read_short/bare_fast_float_loop", read_baseline<&Subject::short_path, sum_of_bvh>);
  measure("read/ifstream", read_ifstream);
  measure("read_blocks/kinefile", read_blocks);
#ifdef KINEFILE_HAS_ASSIMP
  measure("read/assimp", read_assimp);
#endif
  measure("read_amc/kinefile", read_kinefile<&Subject::amc_path>);
  measure("read_amc/bare_fast_float_loop",
          read_baseline<&Subject::amc_path, sum_words_with_fast_float>);
  measure("read_csv/kinefile", read_kinefile<&Subject::csv_path>);
  measure("read_csv/bare_fast_float_loop", read_baseline<&Subject::csv_path, sum_with_commas>);
  measure("read_seq/kinefile", read_kinefile<&Subject::seq_path>);
  measure("read_seq/libyaml_strtod", read_baseline<&Subject::seq_path, sum_with_libyaml>);
  measure("read_rounded_seq/kinefile", read_kinefile<&Subject::rounded_seq_path>);
  measure("read_rounded_seq/libyaml_strtod",
          read_baseline<&Subject::rounded_seq_path, sum_with_libyaml>);
  measure("read_on_one_thread", read_on_threads<1>, Time::Clock);
  measure("read_on_two_threads", read_on_threads<2>, Time::Clock);
  measure("write/kinefile", write_kinefile);
  compare("reading BVH, against a bare fast_float loop", "read/kinefile",
          "read/bare_fast_float_loop");
  compare("reading BVH of shortest numbers, against the same", "read_short/kinefile",
          "read_short/bare_fast_float_loop");
  compare("reading BVH, against ifstream >>", "read/kinefile", "read/ifstream");
  compare("reading BVH block by block, against a fast_float loop", "read_blocks/kinefile",
          "read/bare_fast_float_loop");
  compare("reading BVH, against assimp's importer", "read/kinefile", "read/assimp");
  compare("reading AMC, against a bare fast_float loop", "read_amc/kinefile",
          "read_amc/bare_fast_float_loop");
  compare("reading CSV, against a bare fast_float loop", "read_csv/kinefile",
          "read_csv/bare_fast_float_loop");
  compare("reading .seq of 17 digits, against libyaml and strtod", "read_seq/kinefile",
          "read_seq/libyaml_strtod");
  compare("reading .seq of 6 decimals, against libyaml and strtod", "read_rounded_seq/kinefile",
          "read_rounded_seq/libyaml_strtod");
  compare("reading BVH on two threads, against one", "read_on_two_threads", "read_on_one_thread");
}

void print_memory() {
  const auto print = [](const char* what, double ratio) {
    fmt::print("{:<58}{:.2f}\n", what, ratio);
  };
  print("peak memory of reading BVH, as a multiple of the file's size",
        peak_memory_ratio(subject().path, reads_and_places));
  print("peak memory of reading .seq, likewise", peak_memory_ratio(subject().seq_path, reads_seq));
}

}  // namespace kinefile::bench
