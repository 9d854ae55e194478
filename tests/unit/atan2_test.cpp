// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "simd/angles.hpp"

namespace kinefile::simd {
namespace {

double angle_of(double y, double x) {
  std::vector<double> ys(kBlock, y);
  std::vector<double> xs(kBlock, x);
  std::vector<double> angles;
  simd::atan2(ys, xs, angles);
  return angles.front();
}

/// The error in units of the last place of what it should be.
double error_of(double y, double x) {
  const long double expected = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
  const double size = std::abs(static_cast<double>(expected));
  const double unit = std::nextafter(size, 10.0) - size;
  return static_cast<double>(std::abs(angle_of(y, x) - expected) / unit);
}

TEST(Atan2, AgreesWithTheLibraryAllAround) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> number(-1, 1);
  double worst = 0;
  for (int i = 0; i < 50'000; ++i)
    worst = std::max(worst, error_of(number(random), number(random)));
  EXPECT_LT(worst, 2);
}

TEST(Atan2, KeepsItsDigitsCloseToTheAxesAndTheDiagonals) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> number(0.5, 1);
  double worst = 0;
  for (double tiny = 1; tiny > 1e-300; tiny *= 1e-3) {
    for (int i = 0; i < 100; ++i) {
      const double a = number(random);
      const double b = tiny * number(random);
      for (const double sign : {1.0, -1.0}) {
        worst =
            std::max({worst, error_of(sign * b, a), error_of(b, sign * a), error_of(sign * a, b),
                      error_of(a, sign * b), error_of(sign * a, a + b), error_of(a + b, sign * a)});
      }
    }
  }
  EXPECT_LT(worst, 2);
}

TEST(Atan2, IsExactOnTheAxesAndDiagonals) {
  constexpr double kPi = std::numbers::pi;
  EXPECT_EQ(angle_of(0, 0), 0);
  EXPECT_EQ(angle_of(0, 1), 0);
  EXPECT_EQ(angle_of(1, 1), kPi / 4);
  EXPECT_EQ(angle_of(2, 0), kPi / 2);
  EXPECT_EQ(angle_of(1, -1), 3 * kPi / 4);
  EXPECT_EQ(angle_of(0, -3), kPi);
  EXPECT_EQ(angle_of(-0.0, -3), -kPi);
  EXPECT_EQ(angle_of(-1, -1), -3 * kPi / 4);
  EXPECT_EQ(angle_of(-2, 0), -kPi / 2);
}

}  // namespace
}  // namespace kinefile::simd
