// SPDX-License-Identifier: MIT
// Measures kinefile against named baselines in the same run and prints the ratios.

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <span>

#include "baselines.hpp"
#include "keyframes.hpp"
#include "kinefile/kinefile.hpp"
#include "kinefile/retime.hpp"
#include "walk.hpp"

namespace kinefile::bench {
namespace {

constexpr std::size_t kFrames = 88'000;  // about 50 MB of text

/// What the benchmarks work on: the walk as BVH, and as AMC with its skeleton beside it.
struct Subject {
  std::string folder;
  std::string path;
  std::string amc_path;
  std::string seq_path;
  Motion motion;
};

Subject& subject() {
  static Subject instance;
  return instance;
}

Document read_subject() {
  Diagnostics diagnostics;
  auto document = read_file(subject().path, find_format("bvh"), {}, diagnostics);
  if (!document) {
    fmt::print(stderr, "{}\n", to_string(document.error()));
    std::exit(1);
  }
  return std::move(*document);
}

void read_kinefile(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(read_subject());
}

void read_bare_loop(benchmark::State& state) {
  for (auto _ : state) {
    const auto bytes = FileBytes::open(subject().path);
    benchmark::DoNotOptimize(sum_with_fast_float(numbers_of_bvh(bytes->view())));
  }
}

void read_amc_kinefile(benchmark::State& state) {
  for (auto _ : state) {
    Diagnostics diagnostics;
    auto document = read_file(subject().amc_path, find_format("amc"), {}, diagnostics);
    if (!document) state.SkipWithError("not read");
    benchmark::DoNotOptimize(document);
  }
}

void read_amc_bare_loop(benchmark::State& state) {
  for (auto _ : state) {
    const auto bytes = FileBytes::open(subject().amc_path);
    benchmark::DoNotOptimize(sum_words_with_fast_float(bytes->view()));
  }
}

void read_seq_kinefile(benchmark::State& state) {
  for (auto _ : state) {
    Diagnostics diagnostics;
    auto document = read_file(subject().seq_path, find_format("choreonoid"), {}, diagnostics);
    if (!document) state.SkipWithError("not read");
    benchmark::DoNotOptimize(document);
  }
}

void read_seq_libyaml(benchmark::State& state) {
  for (auto _ : state) {
    const auto bytes = FileBytes::open(subject().seq_path);
    benchmark::DoNotOptimize(sum_with_libyaml(bytes->view()));
  }
}

void read_ifstream(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(sum_with_ifstream(subject().path));
}

void fk_kinefile(benchmark::State& state) {
  const Motion& motion = subject().motion;
  for (auto _ : state) {
    benchmark::DoNotOptimize(forward_kinematics(motion.skeleton, motion.clip));
  }
}

void fk_eigen(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(positions_with_eigen(subject().motion));
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

/// As a share of the largest number.
double largest_difference(std::span<const double> a, std::span<const double> b) {
  double largest = 0;
  double difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(a[i]));
    difference = std::max(difference, std::abs(a[i] - b[i]));
  }
  return difference / largest;
}

/// A walk of some thousand frames and a map that shows 15 of its frames in 16, as when frame 150
/// is moved to frame 160.
struct WarpSubject {
  Motion motion = examples::make_walk({.num_frames = 7501});
  retime::TimeMap map;
};

const WarpSubject& warp_subject() {
  static const WarpSubject instance = [] {
    WarpSubject made;
    for (int n = 0; n <= 8000; ++n) made.map.old_frames.push_back(n * 150 / 160.0);
    return made;
  }();
  return instance;
}

Motion warped_with_kinefile(retime::RotationInterpolation rotation) {
  Diagnostics diagnostics;
  auto warped =
      retime::apply(warp_subject().motion, warp_subject().map, {.rotation = rotation}, diagnostics);
  return std::move(warped.value());
}

template <retime::RotationInterpolation kRotation>
void warp_kinefile(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(warped_with_kinefile(kRotation));
}

void warp_eigen(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(warped_with_eigen(warp_subject().motion, warp_subject().map));
  }
}

/// The largest distance of joints in the motions that the two ways to warp give, relative.
double warp_disagreement() {
  const Motion ours = warped_with_kinefile(retime::RotationInterpolation::Slerp);
  Motion theirs = ours;
  theirs.clip.values = warped_with_eigen(warp_subject().motion, warp_subject().map);
  const WorldPoses a = forward_kinematics(ours.skeleton, ours.clip);
  const WorldPoses b = forward_kinematics(theirs.skeleton, theirs.clip);
  return largest_difference(a.positions, b.positions);
}

/// Prints as usual and keeps the fastest time of each benchmark.
class Reporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      const double seconds = run.real_accumulated_time / static_cast<double>(run.iterations);
      auto [found, is_new] = best_.try_emplace(run.run_name.function_name, seconds);
      if (!is_new) found->second = std::min(found->second, seconds);
    }
    ConsoleReporter::ReportRuns(runs);
  }
  double best(const std::string& name) const {
    const auto found = best_.find(name);
    return found == best_.end() ? 0 : found->second;
  }

 private:
  std::map<std::string, double> best_;
};

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
  const Document document = read_subject();
  const Motion& motion = std::get<Motion>(document.content);
  return world_extent(motion.skeleton, motion.clip).min.allFinite();
}

bool reads_seq() {
  Diagnostics diagnostics;
  return read_file(subject().seq_path, nullptr, {}, diagnostics).has_value();
}

/// The largest distance of the two ways to place joints, as a share of the largest coordinate.
double disagreement() {
  const Motion& motion = subject().motion;
  const WorldPoses poses = forward_kinematics(motion.skeleton, motion.clip);
  return largest_difference(positions_with_eigen(motion), poses.positions);
}

void print_ratio(const Reporter& reporter, std::string_view what, const std::string& ours,
                 const std::string& baseline) {
  if (reporter.best(ours) == 0 || reporter.best(baseline) == 0) return;
  fmt::print("{:<58}{:.2f}\n", what, reporter.best(baseline) / reporter.best(ours));
}

void write_or_exit(const std::string& path, const Document& document, const char* format) {
  Diagnostics diagnostics;
  const auto written =
      write_file(path, document, *find_format(format), {}, {.may_replace = true}, diagnostics);
  if (written) return;
  fmt::print(stderr, "{}\n", to_string(written.error()));
  std::exit(1);
}

/// A root and 30 joints, some 50 MB as text.
BodyMotion make_robot_motion() {
  constexpr std::size_t kSeqFrames = 70'000;
  BodyMotion motion;
  const auto add = [&motion](ComponentKind kind, std::string_view content, std::size_t parts) {
    Component& component = motion.components.emplace_back();
    component.kind = kind;
    component.content = content;
    component.num_parts = parts;
    component.num_frames = kSeqFrames;
    component.timeline.given = FrameRate{500};
    for (std::size_t i = 0; i < kSeqFrames * component.row_size(); ++i) {
      component.values.push_back(std::sin(0.37 * static_cast<double>(i)));
    }
  };
  add(ComponentKind::Poses, kLinkPosition, 1);
  add(ComponentKind::Values, kJointDisplacement, 30);
  return motion;
}

void prepare() {
  std::string folder = std::filesystem::temp_directory_path() / "kinefile-bench.XXXXXX";
  if (mkdtemp(folder.data()) == nullptr) {
    fmt::print(stderr, "{} cannot be made\n", folder);
    std::exit(1);
  }
  subject().folder = folder;
  subject().path = folder + "/walk.bvh";
  subject().amc_path = folder + "/walk.amc";
  subject().seq_path = folder + "/robot.seq";
  Document document;
  document.content = examples::make_walk({.num_frames = kFrames});
  write_or_exit(subject().path, document, "bvh");
  Diagnostics diagnostics;
  const auto bones = adapted_to(*find_format("amc"), std::move(document), {}, diagnostics);
  write_or_exit(subject().amc_path, bones.value(), "amc");
  Document robot;
  robot.content = make_robot_motion();
  write_or_exit(subject().seq_path, robot, "choreonoid");
}

int run(int argc, char** argv) {
  // Turn by turn, so that a machine whose speed drifts slows all of them alike.
  std::vector<char*> arguments(argv, argv + argc);
  char interleave[] = "--benchmark_enable_random_interleaving=true";
  arguments.insert(arguments.begin() + 1, interleave);
  arguments.push_back(nullptr);
  int count = argc + 1;
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  prepare();
  // Before this process has grown.
  const double memory = peak_memory_ratio(subject().path, reads_and_places);
  const double seq_memory = peak_memory_ratio(subject().seq_path, reads_seq);
  subject().motion = std::get<Motion>(read_subject().content);
  const auto add = [](const char* benchmark_name, void (*function)(benchmark::State&)) {
    benchmark::RegisterBenchmark(benchmark_name, function)
        ->Unit(benchmark::kMillisecond)
        ->Repetitions(9)
        ->ReportAggregatesOnly(false);
  };
  add("read/kinefile", read_kinefile);
  add("read/bare_fast_float_loop", read_bare_loop);
  add("read/ifstream", read_ifstream);
  add("read_amc/kinefile", read_amc_kinefile);
  add("read_amc/bare_fast_float_loop", read_amc_bare_loop);
  add("read_seq/kinefile", read_seq_kinefile);
  add("read_seq/libyaml_strtod", read_seq_libyaml);
  add("fk/kinefile", fk_kinefile);
  add("fk/eigen_per_frame", fk_eigen);
  add("write/kinefile", write_kinefile);
  add("warp/kinefile", warp_kinefile<retime::RotationInterpolation::Slerp>);
  add("warp/kinefile_cubic", warp_kinefile<retime::RotationInterpolation::Cubic>);
  add("warp/eigen_slerp", warp_eigen);
  Reporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  fmt::print("\n{:.1f} MB of BVH, {} frames; ratios of the fastest of 9 runs, above 1 is faster\n",
             static_cast<double>(std::filesystem::file_size(subject().path)) / 1e6, kFrames);
  print_ratio(reporter, "reading a file, against a bare fast_float loop", "read/kinefile",
              "read/bare_fast_float_loop");
  print_ratio(reporter, "reading a file, against ifstream >>", "read/kinefile", "read/ifstream");
  print_ratio(reporter, "reading AMC, against a bare fast_float loop", "read_amc/kinefile",
              "read_amc/bare_fast_float_loop");
  print_ratio(reporter, "reading .seq, against libyaml's events and strtod", "read_seq/kinefile",
              "read_seq/libyaml_strtod");
  print_ratio(reporter, "forward kinematics, against a plain Eigen loop", "fk/kinefile",
              "fk/eigen_per_frame");
  print_ratio(reporter, "warping time, against a plain Eigen slerp loop", "warp/kinefile",
              "warp/eigen_slerp");
  print_ratio(reporter, "warping time with cubics, against the same", "warp/kinefile_cubic",
              "warp/eigen_slerp");
  fmt::print("{:<58}{:.2f}\n", "peak memory, as a multiple of the file's size", memory);
  fmt::print("{:<58}{:.2f}\n", "peak memory of reading .seq, likewise", seq_memory);
  fmt::print("{:<58}{:.1e}\n", "largest difference of the two kinematics, relative",
             disagreement());
  fmt::print("{:<58}{:.1e}\n", "largest difference of the two warps, relative",
             warp_disagreement());
  print_keyframes();
  std::filesystem::remove_all(subject().folder);
  return 0;
}

}  // namespace
}  // namespace kinefile::bench

int main(int argc, char** argv) { return kinefile::bench::run(argc, argv); }
