// SPDX-License-Identifier: MIT
#include "rows.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>
#include <hwy/highway.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "report.hpp"
#include "text/number_lines.hpp"

namespace kinefile::bench {
namespace {

constexpr std::size_t kRowLength = 96;
constexpr std::size_t kNumRows = 2'000;

/// How numbers are printed.
enum Spelling { SixDecimals, Shortest, TwoDecimals, General, NineDigits, SeventeenDigits, Mixed };

constexpr std::array<const char*, 7> kNames = {"six decimals", "shortest text of six decimals",
                                               "two decimals", "%g",
                                               "nine digits",  "seventeen digits",
                                               "mixed"};

std::string spelled(double value, Spelling spelling, std::mt19937& random) {
  switch (spelling) {
    case SixDecimals:
      return fmt::format("{:.6f}", value);
    case Shortest:
      return fmt::format("{}", std::round(value * 1e6) / 1e6);
    case TwoDecimals:
      return fmt::format("{:.2f}", value);
    case General:
      return fmt::format("{:g}", value);
    case NineDigits:
      return fmt::format("{}", static_cast<float>(value));
    case SeventeenDigits:
      return fmt::format("{}", value);
    default:
      break;
  }
  constexpr std::array<Spelling, 3> kSome = {SixDecimals, General, SeventeenDigits};
  const std::size_t kind = random() % 4;
  return kind == 3 ? fmt::format("{}", static_cast<int>(value))
                   : spelled(value, kSome[kind], random);
}

/// Angles and positions of a figure: up to some hundred, many of them small.
const std::string& text_of(Spelling spelling) {
  static std::array<std::string, kNames.size()> texts;
  std::string& text = texts[spelling];
  if (!text.empty()) return text;
  std::mt19937 random(1);
  for (std::size_t i = 0; i < kNumRows * kRowLength; ++i) {
    const double unit = (static_cast<double>(random()) / 2147483648.0) - 1;
    text += spelled(unit * std::pow(10.0, random() % 3), spelling, random);
    text += i % kRowLength == kRowLength - 1 ? '\n' : ' ';
  }
  return text;
}

std::vector<double>& numbers() {
  static std::vector<double> made(kNumRows * kRowLength);
  return made;
}

template <Spelling kSpelling>
void rows_kinefile(benchmark::State& state) {
  const std::string& text = text_of(kSpelling);
  for (auto _ : state) {
    const auto read = text::read_number_lines(text.data(), text.data() + text.size(), kRowLength,
                                              kNumRows, numbers().data());
    if (read.num_rows != kNumRows) state.SkipWithError("not read");
    benchmark::ClobberMemory();
  }
}

/// The same as on a processor with SSE4.2 and no wider vectors.
template <Spelling kSpelling>
void rows_on_sse4(benchmark::State& state) {
  hwy::SetSupportedTargetsForTest(HWY_STATIC_TARGET | HWY_SSSE3 | HWY_SSE4);
  rows_kinefile<kSpelling>(state);
  hwy::SetSupportedTargetsForTest(0);
}

template <Spelling kSpelling>
void rows_fast_float(benchmark::State& state) {
  const std::string& text = text_of(kSpelling);
  const char* const end = text.data() + text.size();
  for (auto _ : state) {
    const char* p = text.data();
    for (double& number : numbers()) {
      while (p != end && (*p == ' ' || *p == '\n')) ++p;
      p = fast_float::from_chars(p, end, number).ptr;
    }
    benchmark::ClobberMemory();
  }
}

template <Spelling kSpelling>
void add() {
  const std::string name = fmt::format("rows_{}", static_cast<int>(kSpelling));
  measure(name + "/kinefile", rows_kinefile<kSpelling>);
  measure(name + "/fast_float", rows_fast_float<kSpelling>);
  compare(fmt::format("number rows, {}, against fast_float", kNames[kSpelling]), name + "/kinefile",
          name + "/fast_float");
  measure(name + "/sse4", rows_on_sse4<kSpelling>);
  compare(fmt::format("the same on SSE4.2, {}", kNames[kSpelling]), name + "/sse4",
          name + "/fast_float");
}

}  // namespace

void add_rows() {
  add<SixDecimals>();
  add<Shortest>();
  add<TwoDecimals>();
  add<General>();
  add<NineDigits>();
  add<SeventeenDigits>();
  add<Mixed>();
}

}  // namespace kinefile::bench
