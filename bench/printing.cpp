// SPDX-License-Identifier: MIT
#include "printing.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cstdlib>
#include <random>
#include <vector>

#include "report.hpp"
#include "simd/number_text.hpp"

namespace kinefile::bench {
namespace {

constexpr std::size_t kColumns = 96;
constexpr std::size_t kRows = 1000;

/// Angles that no decimals tell.
const std::vector<double>& angles() {
  static const std::vector<double> all = [] {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<> angle(-180, 180);
    std::vector<double> numbers(kRows * kColumns);
    for (double& number : numbers) number = angle(random);
    return numbers;
  }();
  return all;
}

/// Angles as a file with six decimals has them.
const std::vector<double>& rounded_angles() {
  static const std::vector<double> all = [] {
    std::vector<double> numbers = angles();
    for (double& number : numbers) {
      number = std::strtod(fmt::format("{:.6f}", number).c_str(), nullptr);
    }
    return numbers;
  }();
  return all;
}

void print_rows(benchmark::State& state, const std::vector<double>& numbers,
                const simd::NumberSpelling& spelling) {
  fmt::memory_buffer out;
  for (auto _ : state) {
    out.clear();
    for (std::size_t row = 0; row < kRows; ++row) {
      simd::append_numbers({&numbers[row * kColumns], kColumns}, " ", spelling, out);
    }
    benchmark::DoNotOptimize(out.data());
  }
}

/// The same by fmt, number by number.
template <class Print>
void print_singly(benchmark::State& state, const std::vector<double>& numbers, const Print& print) {
  std::vector<char> out(numbers.size() * 32);
  for (auto _ : state) {
    char* to = out.data();
    for (const double number : numbers) {
      to = print(to, number);
      *to++ = ' ';
    }
    benchmark::DoNotOptimize(out.data());
  }
}

char* print_shortest(char* out, double number) {
  return fmt::format_to(out, FMT_COMPILE("{}"), number);
}

void print_fixed_kinefile(benchmark::State& state) { print_rows(state, angles(), {.decimals = 6}); }

void print_fixed_fmt(benchmark::State& state) {
  print_singly(state, angles(), [](char* out, double number) {
    return fmt::format_to(out, FMT_COMPILE("{:.6f}"), number);
  });
}

void print_rounded_kinefile(benchmark::State& state) { print_rows(state, rounded_angles(), {}); }

void print_rounded_fmt(benchmark::State& state) {
  print_singly(state, rounded_angles(), print_shortest);
}

void print_exact_kinefile(benchmark::State& state) { print_rows(state, angles(), {}); }

void print_exact_fmt(benchmark::State& state) { print_singly(state, angles(), print_shortest); }

}  // namespace

void add_printing() {
  measure("print_fixed/kinefile", print_fixed_kinefile);
  measure("print_fixed/fmt_compiled", print_fixed_fmt);
  measure("print_rounded/kinefile", print_rounded_kinefile);
  measure("print_rounded/fmt_compiled", print_rounded_fmt);
  measure("print_exact/kinefile", print_exact_kinefile);
  measure("print_exact/fmt_compiled", print_exact_fmt);
  compare("printing six decimals, against fmt compiled", "print_fixed/kinefile",
          "print_fixed/fmt_compiled");
  compare("shortest text of values with six decimals, likewise", "print_rounded/kinefile",
          "print_rounded/fmt_compiled");
  compare("shortest text of values with 17 digits, likewise", "print_exact/kinefile",
          "print_exact/fmt_compiled");
}

}  // namespace kinefile::bench
