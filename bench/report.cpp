// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <vector>

namespace kinefile::bench {
namespace {

constexpr int kTurns = 10;
constexpr double kMostDrift = 1.25;  ///< of a baseline, beyond which a ratio says nothing

struct Line {
  std::string what;
  std::string ours;
  std::string baseline;
};

std::vector<Line>& lines() {
  static std::vector<Line> all;
  return all;
}

/// The fastest turns of a measurement, every other one of them apart.
struct Times {
  std::array<double, 2> least = {std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::infinity()};
  std::size_t num_turns = 0;

  void add(double seconds) {
    double& half = least[num_turns++ % 2];
    half = std::min(half, seconds);
  }
  double fastest() const { return std::min(least[0], least[1]); }
  /// Whether both halves of the turns say the same, or nearly so.
  bool is_steady() const { return std::max(least[0], least[1]) <= kMostDrift * fastest(); }
};

/// Prints as usual and keeps the times of each measurement.
class Reporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      const bool by_clock = run.run_name.time_type.find("real_time") != std::string::npos;
      const double seconds = (by_clock ? run.real_accumulated_time : run.cpu_accumulated_time) /
                             static_cast<double>(run.iterations);
      times_[run.run_name.function_name].add(seconds);
    }
    ConsoleReporter::ReportRuns(runs);
  }
  const Times* find(const std::string& name) const {
    const auto found = times_.find(name);
    return found == times_.end() ? nullptr : &found->second;
  }

 private:
  std::map<std::string, Times> times_;
};

void print(const Reporter& reporter, const Line& line) {
  const Times* ours = reporter.find(line.ours);
  const Times* baseline = reporter.find(line.baseline);
  if (ours == nullptr || baseline == nullptr) return;
  if (!baseline->is_steady()) {
    fmt::print("{:<58}no verdict: the baseline takes {:.1f} or {:.1f} ms\n", line.what,
               baseline->least[0] * 1e3, baseline->least[1] * 1e3);
    return;
  }
  fmt::print("{:<58}{:.2f}\n", line.what, baseline->fastest() / ours->fastest());
}

}  // namespace

void measure(const std::string& name, void (*function)(benchmark::State&), Time time) {
  benchmark::internal::Benchmark* added = benchmark::RegisterBenchmark(name.c_str(), function);
  added->Unit(benchmark::kMillisecond)->Repetitions(kTurns)->ReportAggregatesOnly(false);
  if (time == Time::Clock) {
    added->UseRealTime();
  } else {
    added->MeasureProcessCPUTime();
  }
}

void compare(const std::string& what, const std::string& ours, const std::string& baseline) {
  lines().push_back({what, ours, baseline});
}

bool run_and_print(int argc, char** argv) {
  std::vector<char*> arguments(argv, argv + argc);
  char interleave[] = "--benchmark_enable_random_interleaving=true";
  arguments.insert(arguments.begin() + 1, interleave);
  arguments.push_back(nullptr);
  int count = argc + 1;
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return false;
  Reporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  fmt::print("\nratios of the fastest of {} turns, above 1 is faster\n", kTurns);
  for (const Line& line : lines()) print(reporter, line);
  return true;
}

}  // namespace kinefile::bench
