// SPDX-License-Identifier: MIT
#include "retime/ease.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinefile/retime.hpp"

namespace kinefile {
namespace {

double eased(const char* name, double u) {
  const auto ease = retime::parse_ease(name);
  EXPECT_TRUE(ease) << name;
  return ease ? retime::ease_at(*ease, u) : std::nan("");
}

TEST(Ease, HasTheValuesOfItsFormula) {
  EXPECT_EQ(eased("none", 0.3), 0.3);
  EXPECT_DOUBLE_EQ(eased("smooth", 0.25), 0.15625);
  EXPECT_DOUBLE_EQ(eased("smoother", 0.25), 0.103515625);
  EXPECT_DOUBLE_EQ(eased("in", 0.5), 0.25);
  EXPECT_DOUBLE_EQ(eased("in:3", 0.5), 0.125);
  EXPECT_DOUBLE_EQ(eased("out:3", 0.5), 0.875);
  EXPECT_DOUBLE_EQ(eased("in-out", 0.25), 0.125);
  EXPECT_DOUBLE_EQ(eased("in-out", 0.75), 0.875);
  EXPECT_DOUBLE_EQ(eased("in:0.5", 0.25), 0.5);
}

TEST(Ease, BezierIsTheCurveOfStyleSheets) {
  EXPECT_NEAR(eased("bezier:0.25,0.1,0.25,1", 0.5), 0.8024033875848571, 1e-14);
  EXPECT_NEAR(eased("bezier:0.42,0,0.58,1", 0.5), 0.5, 1e-15);
  EXPECT_NEAR(eased("bezier:0.3,0.3,0.6,0.6", 0.77), 0.77, 1e-14);
}

TEST(Ease, BezierMeetsItsParameterWhereTheCurveIsUpright) {
  for (const auto& [x1, x2] : {std::pair(1.0, 0.0), std::pair(0.0, 0.0), std::pair(1.0, 1.0)}) {
    // With y as x the curve is the diagonal, however fast it is run through.
    const retime::Ease ease{retime::Ease::Kind::Bezier, 2, x1, x1, x2, x2};
    for (double u = 0; u <= 1; u += 1.0 / 64) EXPECT_NEAR(retime::ease_at(ease, u), u, 1e-12) << x1;
  }
}

TEST(Ease, EndsAreExact) {
  for (const char* name :
       {"none", "smooth", "smoother", "in:2.7", "out:0.3", "in-out:5", "bezier:0.1,0.7,0.9,0.3"}) {
    EXPECT_EQ(eased(name, 0), 0) << name;
    EXPECT_EQ(eased(name, 1), 1) << name;
  }
}

TEST(Ease, ItsWordIsReadAsTheSame) {
  for (const char* name : {"none", "smooth", "smoother", "in", "out:3", "in-out:0.1",
                           "in:0.30000000000000004", "bezier:0.25,-0.1,1,1e-07"}) {
    const auto ease = retime::parse_ease(name);
    ASSERT_TRUE(ease) << name;
    EXPECT_EQ(retime::word_of(*ease), name);
  }
  EXPECT_EQ(retime::word_of(*retime::parse_ease("in:2")), "in");
}

TEST(Ease, WhatIsNoEaseIsNotRead) {
  for (const char* name : {"",
                           "Smooth",
                           "smooth:2",
                           "none:",
                           "in:",
                           "in:0",
                           "in:-1",
                           "in:x",
                           "in:2 ",
                           "in: 2",
                           "in:2,3",
                           "in:inf",
                           "in:nan",
                           "in:1e999",
                           "bezier",
                           "bezier:0,0,1",
                           "bezier:0,0,1,1,",
                           "bezier:-0.1,0,1,1",
                           "bezier:0,0,1.1,1",
                           "bezier:0,nan,1,1",
                           "bezier:0,0,1,1,0"}) {
    EXPECT_FALSE(retime::parse_ease(name)) << name;
  }
}

TEST(Ease, TellsWhichBezierCurvesGoBack) {
  EXPECT_FALSE(retime::goes_back(*retime::parse_ease("bezier:0.3,0,0.7,1")));
  EXPECT_FALSE(retime::goes_back(*retime::parse_ease("bezier:0,1,1,0")));
  EXPECT_FALSE(retime::goes_back(*retime::parse_ease("bezier:0.3,1.2,0.7,0.9")));
  EXPECT_TRUE(retime::goes_back(*retime::parse_ease("bezier:0.3,-0.1,0.7,1")));
  EXPECT_TRUE(retime::goes_back(*retime::parse_ease("bezier:0.3,0,0.7,1.1")));
  EXPECT_TRUE(retime::goes_back(*retime::parse_ease("bezier:0.3,1.5,0.7,0.5")));
  EXPECT_FALSE(retime::goes_back(*retime::parse_ease("smooth")));
}

}  // namespace
}  // namespace kinefile
