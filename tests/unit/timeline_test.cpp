// SPDX-License-Identifier: MIT
#include "kinefile/timeline.hpp"

#include <gtest/gtest.h>

namespace kinefile {
namespace {

TEST(Timeline, KeepsWhichOfTimeAndRateWasGiven) {
  Timeline by_time;
  by_time.value = 0.0333333;
  EXPECT_EQ(frame_time(by_time), 0.0333333);
  EXPECT_EQ(time_of_frame(by_time, 3), 3 * 0.0333333);
  Timeline by_rate{Timeline::Given::FrameRate, 120, 0, {}};
  EXPECT_EQ(frame_rate(by_rate), 120);
  EXPECT_EQ(time_of_frame(by_rate, 360), 3);
}

TEST(Timeline, DoesNotAccumulate) {
  Timeline timeline;
  timeline.value = 0.1;
  EXPECT_EQ(time_of_frame(timeline, 1'000'000), 1'000'000 * 0.1);
}

TEST(Timeline, UsesTheFramesOwnTimes) {
  Timeline timeline;
  timeline.times = {0, 0.5, 2};
  EXPECT_EQ(time_of_frame(timeline, 2), 2);
  EXPECT_EQ(duration(timeline, 3), 2);
}

TEST(Timeline, DurationIsOneFrameTimeLessThanTheFrames) {
  Timeline timeline;
  timeline.value = 0.5;
  EXPECT_EQ(duration(timeline, 0), 0);
  EXPECT_EQ(duration(timeline, 1), 0);
  EXPECT_EQ(duration(timeline, 5), 2);
}

TEST(Timeline, TimesThatAreFramesButForRoundingAreThoseFrames) {
  Timeline timeline;
  timeline.given = Timeline::Given::FrameRate;
  timeline.value = 100;
  EXPECT_EQ(frame_of_time(timeline, 0.07), 7);
  EXPECT_EQ(frame_of_time(timeline, 0.29), 29);
  EXPECT_DOUBLE_EQ(frame_of_time(timeline, 0.075), 7.5);
  timeline = {};
  timeline.value = 0.0083333;  // cut off from 120 frames a second
  EXPECT_EQ(frame_of_time(timeline, 1.25), 150);
}

}  // namespace
}  // namespace kinefile
