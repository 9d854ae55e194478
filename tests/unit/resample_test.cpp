// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include "kinefile/retime.hpp"

namespace kinefile {
namespace {

Clip clip_of(std::size_t num_frames, const Timeline& timeline) {
  Clip clip;
  clip.num_frames = num_frames;
  clip.timeline = timeline;
  clip.timeline.first_frame_number = 1;
  return clip;
}

Clip at_rate(std::size_t num_frames, double rate) {
  return clip_of(num_frames, {FrameRate{rate}, 0});
}

double nominal(double frame_time) { return nominal_frame_rate({FrameTime{frame_time}, 0}); }

std::vector<double> frames_of(const Result<retime::TimeMap>& map) {
  EXPECT_TRUE(map) << to_string(map.error());
  return map ? map->old_frames : std::vector<double>{};
}

void expect_fault(const Result<retime::TimeMap>& map) {
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().code, "RTM002");
  EXPECT_EQ(map.error().kind, ErrorKind::Usage);
}

TEST(NominalFrameRate, CutOffTimesStandForWholeRates) {
  EXPECT_EQ(nominal(0.0083333), 120);
  EXPECT_EQ(nominal(0.008333), 120);
  EXPECT_EQ(nominal(0.00833), 120);
  EXPECT_EQ(nominal(0.0333333), 30);
  EXPECT_EQ(nominal(0.033333), 30);
  EXPECT_EQ(nominal(0.0333), 30);
  EXPECT_EQ(nominal(0.016667), 60);
  EXPECT_EQ(nominal(0.0166667), 60);
  EXPECT_EQ(nominal(0.016666), 60);
  EXPECT_EQ(nominal(0.0167), 60);
  EXPECT_EQ(nominal(1.0 / 120), 120);
  EXPECT_EQ(nominal(0.04), 25);
  EXPECT_EQ(nominal(0.01), 100);
  EXPECT_EQ(nominal(1), 1);
  EXPECT_EQ(nominal(0.03333323), 30) << "a part in 100,000 beside it, as in files of SOMA";
  EXPECT_EQ(nominal(0.00833341), 120);
}

TEST(NominalFrameRate, TelevisionHasRatesOfItsOwn) {
  EXPECT_EQ(nominal(0.0333667), 30000.0 / 1001);
  EXPECT_EQ(nominal(0.033367), 30000.0 / 1001);
  EXPECT_EQ(nominal(0.0417083), 24000.0 / 1001);
  EXPECT_EQ(nominal(0.0166833), 60000.0 / 1001);
}

TEST(NominalFrameRate, OtherTimesAreTakenAtTheirWord) {
  EXPECT_EQ(nominal(0.03), 1 / 0.03);
  EXPECT_EQ(nominal(0.033), 1 / 0.033);
  EXPECT_EQ(nominal(0.01237), 1 / 0.01237);
  EXPECT_EQ(nominal(2.5), 1 / 2.5);
  EXPECT_EQ(nominal(1e-12), 1 / 1e-12);
  EXPECT_EQ(nominal(0.0333344), 1 / 0.0333344) << "too far from 30";
  EXPECT_EQ(nominal(1.23456e-5), 1 / 1.23456e-5) << "81000.5, a rate in no use";
  EXPECT_EQ(nominal_frame_rate({FrameRate{29.97}, 0}), 29.97);
  EXPECT_EQ(nominal(0), std::numeric_limits<double>::infinity());
}

TEST(ResampleMap, WholeFramesStayWhole) {
  const auto map = retime::resample_map(at_rate(241, 120), 30);
  const auto frames = frames_of(map);
  ASSERT_EQ(frames.size(), 61u);
  for (std::size_t n = 0; n < frames.size(); ++n) EXPECT_EQ(frames[n], 4.0 * double(n));
  EXPECT_EQ(*map->timeline, (Timeline{FrameRate{30}, 1}));
}

TEST(ResampleMap, ACutOffFrameTimeGivesWholeFrames) {
  const auto frames = frames_of(retime::resample_map(clip_of(240, {FrameTime{0.0083333}, 0}), 60));
  ASSERT_EQ(frames.size(), 121u);  // 119.5 new frames, and the end
  for (std::size_t n = 0; n < 120; ++n) EXPECT_EQ(frames[n], 2.0 * double(n));
  EXPECT_EQ(frames[120], 239);
}

TEST(ResampleMap, TheSameRateChangesNothing) {
  const auto frames = frames_of(retime::resample_map(at_rate(1000, 29.97), 29.97));
  ASSERT_EQ(frames.size(), 1000u);
  for (std::size_t n = 0; n < frames.size(); ++n) EXPECT_EQ(frames[n], double(n));
}

TEST(ResampleMap, FractionsAreRoundedOnce) {
  const auto frames = frames_of(retime::resample_map(at_rate(11, 24), 60));
  ASSERT_EQ(frames.size(), 26u);
  for (std::size_t n = 0; n < frames.size(); ++n) EXPECT_EQ(frames[n], double(n) * 24 / 60);
  EXPECT_EQ(frames.back(), 10);
}

TEST(ResampleMap, MotionsOfOneFrameOrNone) {
  EXPECT_TRUE(frames_of(retime::resample_map(at_rate(0, 60), 30)).empty());
  EXPECT_EQ(frames_of(retime::resample_map(at_rate(1, 60), 30)), std::vector<double>{0});
}

TEST(ResampleMap, UsesTheFramesOwnTimes) {
  Clip clip = at_rate(4, 10);
  clip.timeline.given = FrameTimes{{1, 1.5, 1.5, 3}};
  const auto frames = frames_of(retime::resample_map(clip, 4));
  const std::vector<double> expected = {
      0, 0.5, 2, 2 + 0.25 / 1.5, 2 + 0.5 / 1.5, 2 + 0.75 / 1.5, 2 + 1 / 1.5, 2 + 1.25 / 1.5, 3};
  ASSERT_EQ(frames.size(), expected.size());
  for (std::size_t n = 0; n < frames.size(); ++n) EXPECT_NEAR(frames[n], expected[n], 1e-12);
  clip.timeline.given = FrameTimes{{1, 3, 2, 4}};
  expect_fault(retime::resample_map(clip, 4));
}

TEST(SteadyMap, ShowsFramesWhereTheirTimesAre) {
  Clip clip = clip_of(4, {FrameTimes{{0.1, 0.133, 0.2, 0.233}}, 0});
  EXPECT_EQ(frames_of(retime::steady_map(clip, 30, 0.1)), (std::vector<double>{0, 1, 1.5, 2, 3}));
  EXPECT_EQ(frames_of(retime::steady_map(clip, 30, 0)),
            (std::vector<double>{0, 0, 0, 0, 1, 1.5, 2, 3}));
  clip.timeline.given = FrameTimes{{0, 0.25, 1}};
  const auto map = retime::steady_map(clip_of(3, clip.timeline), 2.5, 0);
  const auto frames = frames_of(map);  // at 0, 0.4, 0.8 and the end
  ASSERT_EQ(frames.size(), 4u);
  EXPECT_NEAR(frames[1], 1.2, 1e-12);
  EXPECT_EQ(frames[3], 2);
  EXPECT_EQ(map->timeline->given, decltype(Timeline::given)(FrameRate{2.5}));
  expect_fault(retime::steady_map(clip, 0, 0));
  clip.timeline.given = FrameTimes{{0, 1, 0.5}};
  expect_fault(retime::steady_map(clip, 10, 0));
}

TEST(RateFor, IsTheFilesOrASteadyOne) {
  EXPECT_EQ(retime::rate_for({FrameTimes{{0, 0.1}, 100}, 0})->per_second, 100);
  EXPECT_EQ(retime::rate_for({FrameTimes{{0, 0.1}}, 0})->per_second, 10);
  EXPECT_EQ(retime::rate_for({FrameRate{48}, 0})->per_second, 48);
  EXPECT_FALSE(retime::rate_for({FrameTimes{{0.1, 0}}, 0}));
}

TEST(ResampleMap, RatesHaveToBePossible) {
  for (const double rate : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::quiet_NaN(), 1e12, 1e300}) {
    expect_fault(retime::resample_map(at_rate(100, 30), rate));
  }
  expect_fault(retime::resample_map(clip_of(100, {FrameTime{0}, 0}), 30));
  EXPECT_EQ(frames_of(retime::resample_map(at_rate(100, 30), 1e-300)),
            (std::vector<double>{0, 99}));
}

TEST(SpeedMap, PassesOverFrames) {
  const auto map = retime::speed_map(at_rate(10, 30), 2);
  EXPECT_EQ(frames_of(map), (std::vector<double>{0, 2, 4, 6, 8, 9}));
  EXPECT_FALSE(map->timeline);
  EXPECT_EQ(frames_of(retime::speed_map(at_rate(3, 30), 0.5)),
            (std::vector<double>{0, 0.5, 1, 1.5, 2}));
  EXPECT_EQ(frames_of(retime::speed_map(at_rate(4, 30), 0.3)).size(), 11u);  // 3 / 0.3 is 10
  expect_fault(retime::speed_map(at_rate(10, 30), 0));
  expect_fault(retime::speed_map(at_rate(10, 30), 1e-300));
}

TEST(SpeedMap, UsesTheFramesOwnTimes) {
  Clip clip = at_rate(3, 10);
  clip.timeline.given = FrameTimes{{0, 0.1, 0.4}};
  const auto map = retime::speed_map(clip, 2);
  const auto frames = frames_of(map);
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_NEAR(frames[1], 1 + 1.0 / 3, 1e-12);
  EXPECT_EQ(map->timeline->given, decltype(Timeline::given)(FrameRate{10}));
}

}  // namespace
}  // namespace kinefile
