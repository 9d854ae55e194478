// SPDX-License-Identifier: MIT
#include "kinefile/timeline.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace kinefile {
namespace {

TEST(Timeline, KeepsWhichOfTimeAndRateWasGiven) {
  Timeline by_time;
  by_time.given = FrameTime{0.0333333};
  EXPECT_EQ(frame_time(by_time), 0.0333333);
  EXPECT_EQ(time_of_frame(by_time, 3), 3 * 0.0333333);
  Timeline by_rate{FrameRate{120}, 0};
  EXPECT_EQ(frame_rate(by_rate), 120);
  EXPECT_EQ(time_of_frame(by_rate, 360), 3);
}

TEST(Timeline, DoesNotAccumulate) {
  Timeline timeline;
  timeline.given = FrameTime{0.1};
  EXPECT_EQ(time_of_frame(timeline, 1'000'000), 1'000'000 * 0.1);
}

TEST(Timeline, UsesTheFramesOwnTimes) {
  Timeline timeline;
  timeline.given = FrameTimes{{0, 0.5, 2}};
  EXPECT_EQ(time_of_frame(timeline, 2), 2);
  EXPECT_EQ(duration(timeline, 3), 2);
}

TEST(Timeline, DurationIsOneFrameTimeLessThanTheFrames) {
  Timeline timeline;
  timeline.given = FrameTime{0.5};
  EXPECT_EQ(duration(timeline, 0), 0);
  EXPECT_EQ(duration(timeline, 1), 0);
  EXPECT_EQ(duration(timeline, 5), 2);
}

TEST(Timeline, SpellingsOfARateAgree) {
  const std::vector<Timeline> thirty = {{FrameTime{0.0333333}, 0},  {FrameTime{0.033333}, 0},
                                        {FrameTime{0.03333323}, 0}, {FrameTime{1.0 / 30}, 0},
                                        {FrameTime{0.0333}, 0},     {FrameRate{30}, 0}};
  const std::vector<Timeline> others = {{FrameTime{0.0333667}, 0}, {FrameRate{29.97}, 0},
                                        {FrameRate{30.001}, 0},    {FrameTime{0.033}, 0},
                                        {FrameTime{0.04}, 0},      {FrameRate{60}, 0}};
  for (const Timeline& a : thirty) {
    for (const Timeline& b : thirty) EXPECT_TRUE(have_same_rate(a, b) && have_same_times(a, b));
    for (const Timeline& b : others) EXPECT_FALSE(have_same_rate(a, b) || have_same_rate(b, a));
  }
  EXPECT_TRUE(have_same_rate(others[0], others[1])) << "29.97 is 30 / 1.001";
  EXPECT_TRUE(have_same_rate({FrameRate{23.976}, 0}, {FrameTime{0.0417083}, 0}));
  EXPECT_TRUE(have_same_rate({FrameTime{1e300}, 0}, {FrameTime{1e300}, 0}));
  EXPECT_FALSE(have_same_rate({FrameTime{1e300}, 0}, {FrameTime{1e299}, 0}));
}

double steady(std::vector<double> times) {
  const auto rate = steady_rate(times);
  return rate ? (rate->holds_times ? rate->per_second : -rate->per_second) : 0;
}

TEST(SteadyRate, IsTheLowestThatHoldsAllTimes) {
  EXPECT_EQ(steady({}), 1);
  EXPECT_EQ(steady({0, 1, 3}), 1);
  EXPECT_EQ(steady({0, 0.1, 0.3, 0.4, 0.7}), 10);
  EXPECT_EQ(steady({0, 0.04, 0.16}), 25);         // 4 / 24 is 0.17
  EXPECT_EQ(steady({0, 0.033, 0.1, 0.167}), 30);  // 0.0333 is 0.033, 0.1667 is 0.167
  EXPECT_EQ(steady({0, 0.017, 0.05, 0.067}), 60);
  EXPECT_EQ(steady({0, 0.0083, 0.025}), 120);
  EXPECT_EQ(steady({0.001, 0.003, 0.007}), 1000);
  EXPECT_EQ(steady({-0.2, 0, 0.4}), 5);
  EXPECT_EQ(steady({0, 1.0 / 3, 1}), 24);  // 8 / 24, in 16 digits
  EXPECT_EQ(steady({0.1, 0.2, 0.1 + 0.2}), 10);
}

TEST(SteadyRate, IsByTheMedianStepWhereNoneHoldsThem) {
  EXPECT_DOUBLE_EQ(steady({0, 0.10001, 0.30003, 0.40008, 0.70011}), -1 / 0.10005);
  EXPECT_DOUBLE_EQ(steady({0, 0.00013, 0.0005}), -1 / 0.00013);
}

TEST(SteadyRate, TimesHaveToRise) {
  EXPECT_EQ(steady({0, 0.3, 0.1}), 0);
  EXPECT_EQ(steady({0, 0.3, 0.3}), 0);
  EXPECT_EQ(steady({0, std::numeric_limits<double>::quiet_NaN()}), 0);
  EXPECT_EQ(steady({0, std::numeric_limits<double>::infinity()}), 0);
}

TEST(Timeline, OwnTimesHaveTheRateOfTheirFileOrASteadyOne) {
  Timeline timeline{FrameTimes{{0, 0.1, 0.3}}, 0};
  EXPECT_EQ(frame_rate(timeline), 10);
  EXPECT_EQ(nominal_frame_rate(timeline), 10);
  EXPECT_EQ(frame_time(timeline), 0.1);
  timeline.given = FrameTimes{{0, 0.1, 0.3}, 50};
  EXPECT_EQ(frame_rate(timeline), 50);
  timeline.given = FrameTimes{{0, 0.3, 0.1}};
  EXPECT_EQ(frame_rate(timeline), 0);
}

TEST(Timeline, OwnTimesGoOnByTheirMedianStep) {
  const Timeline timeline{FrameTimes{{1, 1.5, 1.75, 3.25}}, 0};
  EXPECT_EQ(time_of_frame(timeline, 3), 3.25);
  EXPECT_EQ(time_of_frame(timeline, 5), 4.25);
  EXPECT_EQ(frame_at_time(timeline, 4.25), 5);
  EXPECT_EQ(frame_at_time(timeline, 1.625), 1.5);
  EXPECT_EQ(frame_at_time(timeline, 3.25), 3);
  EXPECT_EQ(frame_at_time(timeline, 0.5), -1);
  EXPECT_EQ(frame_at_time({FrameTimes{{2}}, 0}, 7), 0);
  EXPECT_EQ(time_of_frame({FrameTimes{}, 0}, 3), 0);
}

TEST(Timeline, APositionStaysWithinTheFrames) {
  const std::vector<double> back = {0, 0.3, 0.1};  // as a lenient reader may leave them
  for (const double time : {-1.0, 0.0, 0.05, 0.2, 0.3, 5.0}) {
    const FramePosition position = position_in_time(back, time);
    EXPECT_LT(position.frame, back.size());
    EXPECT_TRUE(position.share >= 0 && position.share < 1);
  }
}

TEST(Timeline, TimesThatAreFramesButForRoundingAreThoseFrames) {
  Timeline timeline;
  timeline.given = FrameRate{100};
  EXPECT_EQ(frame_at_time(timeline, 0.07), 7);
  EXPECT_EQ(frame_at_time(timeline, 0.29), 29);
  EXPECT_DOUBLE_EQ(frame_at_time(timeline, 0.075), 7.5);
  timeline = {};
  timeline.given = FrameTime{0.0083333};  // cut off from 120 frames a second
  EXPECT_EQ(frame_at_time(timeline, 1.25), 150);
}

}  // namespace
}  // namespace kinefile
