// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "simd/forward_kinematics.hpp"

namespace kinefile::simd {
namespace {

struct SinCos {
  double sine;
  double cosine;
};

SinCos of_degrees(double angle) {
  SinCos result{};
  sincos(&angle, 1, true, &result.sine, &result.cosine);
  return result;
}

SinCos of_radians(double angle) {
  SinCos result{};
  sincos(&angle, 1, false, &result.sine, &result.cosine);
  return result;
}

TEST(SinCos, IsExactAtRightAngles) {
  const double sines[] = {0, 1, 0, -1};
  for (int turn = -8; turn <= 8; ++turn) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      const SinCos result = of_degrees(360.0 * turn + 90 * quarter);
      EXPECT_EQ(result.sine, sines[quarter]);
      EXPECT_EQ(result.cosine, sines[(quarter + 1) % 4]);
    }
  }
  EXPECT_EQ(of_degrees(360e9 + 90).sine, 1);
}

TEST(SinCos, AgreesWithTheLibraryInRadians) {
  std::mt19937_64 random(5);
  for (const double range : {1.0, 10.0, 1e4, 1e6, 1e9, 1e300}) {
    std::uniform_real_distribution<double> angle(-range, range);
    for (int i = 0; i < 10'000; ++i) {
      const double a = angle(random);
      const SinCos result = of_radians(a);
      ASSERT_NEAR(result.sine, std::sin(a), 3e-16) << a;
      ASSERT_NEAR(result.cosine, std::cos(a), 3e-16) << a;
    }
  }
}

TEST(SinCos, AgreesWithTheLibraryInDegrees) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> angle(-3000, 3000);
  for (int i = 0; i < 50'000; ++i) {
    const double a = angle(random);
    const SinCos result = of_degrees(a);
    const long double radians = static_cast<long double>(a) * 3.14159265358979323846264L / 180;
    ASSERT_NEAR(result.sine, static_cast<double>(std::sin(radians)), 3e-16) << a;
    ASSERT_NEAR(result.cosine, static_cast<double>(std::cos(radians)), 3e-16) << a;
  }
}

TEST(SinCos, OneOddAngleDoesNotDisturbTheOthersOfItsBlock) {
  const double angles[] = {30, std::numeric_limits<double>::infinity(), 90, std::nan(""), 1e30};
  double sines[5];
  double cosines[5];
  sincos(angles, 5, true, sines, cosines);
  EXPECT_EQ(sines[0], of_degrees(30).sine);
  EXPECT_TRUE(std::isnan(sines[1]));
  EXPECT_EQ(sines[2], 1);
  EXPECT_TRUE(std::isnan(cosines[3]));
  EXPECT_NEAR(sines[4] * sines[4] + cosines[4] * cosines[4], 1, 1e-15);
}

}  // namespace
}  // namespace kinefile::simd
