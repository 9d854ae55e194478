// SPDX-License-Identifier: MIT
// Text of numbers by vectors, held against fmt on every instruction set that this machine has.
#include "simd/number_text.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cfloat>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace kinefile::simd {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string text_of(const std::vector<double>& numbers, const NumberSpelling& spelling,
                    std::string_view separator = " ") {
  fmt::memory_buffer out;
  append_numbers(numbers, separator, spelling, out);
  return {out.data(), out.size()};
}

std::string text_by_fmt(const std::vector<double>& numbers, const NumberSpelling& spelling,
                        std::string_view separator = " ") {
  std::string text;
  for (const double number : numbers) {
    text += spelling.decimals ? fmt::format("{:.{}f}", number, *spelling.decimals)
                              : fmt::format("{}", number);
    text += separator;
  }
  return text;
}

void expect_same(const std::vector<double>& numbers, const NumberSpelling& spelling) {
  const std::string text = text_of(numbers, spelling);
  const std::string expected = text_by_fmt(numbers, spelling);
  if (text == expected) return;
  for (const double number : numbers) {
    ASSERT_EQ(text_of({number}, spelling), text_by_fmt({number}, spelling))
        << fmt::format("{:a}, {} decimals", number, spelling.decimals.value_or(-1));
  }
  ASSERT_EQ(text, expected);  // each number alone is right
}

/// Holds numbers, and their negatives, against fmt in the shortest form and with all decimals.
void expect_same_in_all_forms(const std::vector<double>& numbers) {
  std::vector<double> negatives = numbers;
  for (double& number : negatives) number = -number;
  for (const auto& signed_numbers : {numbers, negatives}) {
    ASSERT_NO_FATAL_FAILURE(expect_same(signed_numbers, {}));
  }
  for (int decimals = 0; decimals <= 17; ++decimals) {
    const auto& signed_numbers = decimals % 2 == 0 ? numbers : negatives;
    ASSERT_NO_FATAL_FAILURE(expect_same(signed_numbers, {.decimals = decimals}));
  }
}

/// A test on one of the instruction sets.
class NumberText : public testing::TestWithParam<std::int64_t> {
 protected:
  void SetUp() override { hwy::SetSupportedTargetsForTest(GetParam()); }
  void TearDown() override { hwy::SetSupportedTargetsForTest(0); }

  double uniform(double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random_);
  }
  double of_any_bits() {
    const std::uint64_t bits = random_();
    double number = 0;
    std::memcpy(&number, &bits, sizeof number);
    return std::isnan(number) ? kInfinity : number;
  }

  std::mt19937_64 random_{1};
};

std::vector<std::int64_t> targets_here() {
  std::vector<std::int64_t> targets;
  std::int64_t rest = hwy::SupportedTargets() & HWY_TARGETS;
  for (; rest != 0; rest &= rest - 1) targets.push_back(rest & -rest);
  return targets;
}

INSTANTIATE_TEST_SUITE_P(Targets, NumberText, testing::ValuesIn(targets_here()),
                         [](const auto& target) { return hwy::TargetName(target.param); });

/// Numbers and those beside them.
std::vector<double> with_neighbours(const std::vector<double>& numbers) {
  std::vector<double> all;
  for (const double number : numbers) {
    double below = number;
    double above = number;
    all.push_back(number);
    for (int step = 0; step < 3; ++step) {
      below = std::nextafter(below, -kInfinity);
      above = std::nextafter(above, kInfinity);
      all.push_back(below);
      all.push_back(above);
    }
  }
  return all;
}

TEST_P(NumberText, IsThatOfFmtForAnyDoubles) {
  for (int round = 0; round < 2; ++round) {
    std::vector<double> numbers(200);
    for (double& number : numbers) number = of_any_bits();
    ASSERT_NO_FATAL_FAILURE(expect_same_in_all_forms(numbers));
  }
}

TEST_P(NumberText, IsThatOfFmtForNumbersOfEachSize) {
  for (int exponent = -30; exponent <= 70; ++exponent) {
    std::vector<double> numbers(24);
    for (double& number : numbers) number = std::ldexp(uniform(1, 2), exponent);
    ASSERT_NO_FATAL_FAILURE(expect_same_in_all_forms(numbers));
  }
}

TEST_P(NumberText, IsThatOfFmtForNumbersOfSoManyDecimals) {
  for (int decimals = 0; decimals <= 17; ++decimals) {
    for (const double size : {1e-3, 1.0, 180.0, 1e5, 1e9, 1e15}) {
      std::vector<double> numbers(100);
      for (double& number : numbers) {
        number = std::strtod(fmt::format("{:.{}f}", uniform(0, size), decimals).c_str(), nullptr);
      }
      ASSERT_NO_FATAL_FAILURE(expect_same(numbers, {}));
      ASSERT_NO_FATAL_FAILURE(expect_same(numbers, {.decimals = decimals}));
      ASSERT_NO_FATAL_FAILURE(expect_same(numbers, {.decimals = std::max(decimals - 1, 0)}));
    }
  }
}

TEST_P(NumberText, IsThatOfFmtForNumbersOfSoManyDigits) {
  for (int digits = 1; digits <= 17; ++digits) {
    for (int exponent = -8; exponent <= 20; ++exponent) {
      std::vector<double> numbers(24);
      for (double& number : numbers) {
        const double value = uniform(1, 10) * std::pow(10, exponent);
        number = std::strtod(fmt::format("{:.{}e}", value, digits - 1).c_str(), nullptr);
      }
      ASSERT_NO_FATAL_FAILURE(expect_same(numbers, {}));
    }
  }
}

TEST_P(NumberText, IsThatOfFmtBesideTheMiddle) {
  for (int decimals = 0; decimals <= 15; ++decimals) {
    const double power = std::pow(10, decimals);
    std::vector<double> middles;
    for (int i = 0; i < 60; ++i) {
      const double whole = std::floor(std::ldexp(uniform(0.5, 1), i));
      middles.push_back((whole + 0.5) / power);
      middles.push_back(std::floor(whole) / 64 + 1.0 / 128);  // dyadic: exact middles among them
    }
    middles.push_back(0.5);
    middles.push_back(2.5);
    middles.push_back(0.125);
    ASSERT_NO_FATAL_FAILURE(expect_same(with_neighbours(middles), {.decimals = decimals}));
  }
}

TEST_P(NumberText, IsThatOfFmtBesidePowersOfTenAndTwo) {
  std::vector<double> powers;
  for (int exponent = -25; exponent <= 25; ++exponent) powers.push_back(std::pow(10, exponent));
  for (int exponent = -25; exponent <= 70; ++exponent) powers.push_back(std::ldexp(1, exponent));
  for (const double scale : {1.0, 9.5, 0.99999999999999989}) {
    std::vector<double> scaled = powers;
    for (double& number : scaled) number *= scale;
    ASSERT_NO_FATAL_FAILURE(expect_same_in_all_forms(with_neighbours(scaled)));
  }
}

TEST_P(NumberText, IsThatOfFmtForWholeNumbers) {
  std::vector<double> numbers;
  for (int i = 0; i <= 120; ++i) numbers.push_back(i);
  for (double power = 1e3; power < 1e18; power *= 10) {
    for (const double digit : {1.0, 2.0, 5.0, 9.0}) {
      for (const double step : {-1.0, 0.0, 1.0}) numbers.push_back(digit * power + step);
    }
  }
  for (int i = 0; i < 120; ++i) {
    numbers.push_back(std::floor(std::ldexp(uniform(0, 1), i % 60)));
    // Ends of the halves of 8 digits.
    const double halves = std::floor(uniform(0, 1e6)) * 1e8;
    for (const double step : {-1.0, 0.0, 1.0}) numbers.push_back(std::abs(halves + step));
  }
  expect_same_in_all_forms(numbers);
}

TEST_P(NumberText, IsThatOfFmtForSmallAndLargeNumbers) {
  expect_same_in_all_forms(with_neighbours({0.0,
                                            1e-4,
                                            1e-5,
                                            9.9999e-5,
                                            1.0 / 8192,
                                            1.0 / 16384,
                                            0.5,
                                            0.05,
                                            0.005,
                                            1e14,
                                            1e15,
                                            1e16,
                                            999999999999999.0,
                                            9999999999999998.0,
                                            9007199254740992.0,
                                            2251799813685248.0,
                                            4503599627370496.0,
                                            DBL_MIN,
                                            DBL_TRUE_MIN,
                                            1e-310,
                                            DBL_MAX / 2}));
  expect_same_in_all_forms({DBL_MAX, kInfinity});
}

TEST_P(NumberText, IsThatOfFmtForManyDecimals) {
  for (const int decimals : {18, 30, 100}) {
    expect_same({0.0, -0.1, 12345.678, 1e300, DBL_TRUE_MIN, -kInfinity}, {.decimals = decimals});
  }
}

TEST_P(NumberText, HasNoSignForNan) {
  EXPECT_EQ(text_of({kNan, -kNan}, {}), "nan nan ");
  EXPECT_EQ(text_of({kNan, -kNan}, {.decimals = 3}), "nan nan ");
}

TEST_P(NumberText, IsSpelledAsAsked) {
  EXPECT_EQ(text_of({kNan, 1, -kInfinity, 1e-5}, {.quotes_non_finite = true}, ","),
            "\"nan\",1,\"-inf\",1e-05,");
  EXPECT_EQ(text_of({1e-5, 1.5e-5, -2e300, 0.5, kInfinity}, {.points_exponents = true}, ", "),
            "1.0e-05, 1.5e-05, -2.0e+300, 0.5, inf, ");
  EXPECT_EQ(text_of({-1.5}, {}, ""), "-1.5");
}

TEST_P(NumberText, IsAppendedForRowsOfEachLength) {
  // Odd numbers at each place of rows of each length, behind something.
  for (std::size_t length = 0; length <= 40; ++length) {
    for (std::size_t odd = 0; odd <= length; ++odd) {
      std::vector<double> numbers(length);
      for (double& number : numbers) number = std::round(uniform(-180e4, 180e4)) / 1e4;
      if (odd < length) numbers[odd] = odd % 2 == 0 ? 1e300 : 1.0 / 3;
      for (const std::string_view separator : {"", ",", ", "}) {
        for (const NumberSpelling& spelling : {NumberSpelling{}, NumberSpelling{.decimals = 6}}) {
          fmt::memory_buffer out;
          out.push_back('[');
          append_numbers(numbers, separator, spelling, out);
          ASSERT_EQ(std::string(out.data(), out.size()),
                    "[" + text_by_fmt(numbers, spelling, separator));
        }
      }
    }
  }
}

}  // namespace
}  // namespace kinefile::simd
