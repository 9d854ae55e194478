// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

namespace kinefile::bench {
namespace {

constexpr int kTurns = 9;

struct Line {
  std::string what;
  std::string ours;
  std::string baseline;
};

std::vector<Line>& lines() {
  static std::vector<Line> all;
  return all;
}

struct Times {
  double least = 0;
  double greatest = 0;
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
      auto [found, is_new] =
          times_.try_emplace(run.run_name.function_name, Times{seconds, seconds});
      Times& times = found->second;
      times = {std::min(times.least, seconds), std::max(times.greatest, seconds)};
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
  fmt::print("{:<58}{:.2f}\n", line.what, baseline->least / ours->least);
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
