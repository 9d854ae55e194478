// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "kinefile/retime.hpp"
#include "retime/dtw.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

constexpr retime::AlignOptions::By kWays[] = {retime::AlignOptions::By::Angles,
                                              retime::AlignOptions::By::Points};

std::vector<double> aligned(const Motion& motion, const Motion& reference,
                            retime::AlignOptions::By by) {
  const auto map = retime::align_map(motion, reference, {by}, test::ignored());
  EXPECT_TRUE(map) << to_string(map.error());
  if (!map) return {};
  EXPECT_EQ(map->old_frames.size(), reference.clip.num_frames);
  EXPECT_TRUE(map->timeline && *map->timeline == reference.clip.timeline);
  return map->old_frames;
}

/// Expects a map that rises from the first frame to the last.
void expect_rise(const std::vector<double>& old_frames, std::size_t num_old_frames) {
  EXPECT_EQ(old_frames.front(), 0);
  EXPECT_EQ(old_frames.back(), double(num_old_frames) - 1);
  for (std::size_t n = 1; n < old_frames.size(); ++n) {
    ASSERT_LT(old_frames[n - 1], old_frames[n]) << n;
  }
}

/// A motion shown by a map, with straight lines between the numbers of neighbouring frames.
Motion shown_by(const Motion& motion, const std::vector<double>& old_frames) {
  Motion result{motion.skeleton, {}};
  result.clip.num_frames = old_frames.size();
  result.clip.num_coordinates = motion.clip.num_coordinates;
  result.clip.timeline = motion.clip.timeline;
  for (const double frame : old_frames) {
    const auto before = static_cast<std::size_t>(frame);
    const std::size_t after = std::min(before + 1, motion.clip.num_frames - 1);
    const double share = frame - double(before);
    for (std::size_t c = 0; c < motion.clip.num_coordinates; ++c) {
      result.clip.values.push_back((1 - share) * motion.clip.row(before)[c] +
                                   share * motion.clip.row(after)[c]);
    }
  }
  return result;
}

std::vector<double> warp_of(std::size_t num_frames, std::vector<retime::WarpKey> keys,
                            retime::Tail tail = retime::Tail::Keep) {
  retime::WarpOptions options;
  options.keys = std::move(keys);
  options.curve = retime::WarpCurve::Pchip;
  options.tail = tail;
  return retime::warp_map(num_frames, options)->old_frames;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t n = 0; n < std::min(a.size(), b.size()); ++n) {
    largest = std::max(largest, std::abs(a[n] - b[n]));
  }
  return largest;
}

TEST(AlignMap, AMotionIsAlignedWithItself) {
  const Motion walk = examples::make_walk({.num_frames = 300});
  for (const auto by : kWays) {
    const auto frames = aligned(walk, walk, by);
    for (std::size_t n = 0; n < frames.size(); ++n) ASSERT_NEAR(frames[n], double(n), 1e-9);
  }
}

TEST(AlignMap, ALongMotionIsAlignedWithItself) {
  const Motion walk = examples::make_walk({.num_frames = 4000});
  const auto frames = aligned(walk, walk, retime::AlignOptions::By::Angles);
  for (std::size_t n = 0; n < frames.size(); ++n) ASSERT_NEAR(frames[n], double(n), 1e-9);
}

TEST(AlignMap, FindsAWarp) {
  const Motion walk = examples::make_walk({.num_frames = 300});
  const auto warp = warp_of(300, {{100, 115}, {200, 190}});
  for (const auto by : kWays) {
    const auto frames = aligned(walk, shown_by(walk, warp), by);
    expect_rise(frames, 300);
    EXPECT_LT(largest_difference(frames, warp), 1.2);
  }
}

TEST(AlignMap, FindsAWarpOfAnotherLength) {
  const Motion walk = examples::make_walk({.num_frames = 300});
  const auto warp = warp_of(300, {{150, 260}, {299, 420}}, retime::Tail::Extend);
  for (const auto by : kWays) {
    const auto frames = aligned(walk, shown_by(walk, warp), by);
    expect_rise(frames, 300);
    EXPECT_LT(largest_difference(frames, warp), 1.2);
  }
}

TEST(AlignMap, PointsMayBeMovedOnTheGround) {
  const Motion walk = examples::make_walk({.num_frames = 200});
  Motion elsewhere = walk;
  elsewhere.skeleton.joints[0].rest_rotation = Quat(Eigen::AngleAxisd(2, Vec3::UnitY()));
  for (std::size_t f = 0; f < 200; ++f) {
    elsewhere.clip.mutate()[f][0] += 500;
    elsewhere.clip.mutate()[f][2] -= 300;
  }
  const auto frames = aligned(elsewhere, walk, retime::AlignOptions::By::Points);
  for (std::size_t n = 0; n < frames.size(); ++n) ASSERT_NEAR(frames[n], double(n), 1e-9);
}

TEST(AlignMap, RisesWhereTheMotionsStandStill) {
  const Motion walk = examples::make_walk({.num_frames = 100});
  std::vector<double> still(200, 50);
  for (std::size_t n = 0; n < 50; ++n) still[n] = double(n);
  for (std::size_t n = 150; n < 200; ++n) still[n] = double(n) - 100;
  expect_rise(aligned(walk, shown_by(walk, still), retime::AlignOptions::By::Angles), 100);
  expect_rise(aligned(shown_by(walk, still), walk, retime::AlignOptions::By::Angles), 200);
  const Motion statue = shown_by(walk, std::vector<double>(80, 7));
  expect_rise(aligned(statue, walk, retime::AlignOptions::By::Points), 80);
}

TEST(AlignMap, LengthsMayDifferMuch) {
  const Motion walk = examples::make_walk({.num_frames = 400});
  const Motion few = shown_by(walk, {0, 100, 200, 300, 399});
  for (const auto by : kWays) {
    expect_rise(aligned(few, walk, by), 5);
    expect_rise(aligned(walk, few, by), 400);
  }
  const Motion one = shown_by(walk, {3});
  EXPECT_EQ(aligned(one, walk, kWays[0]), std::vector<double>(400, 0));
  EXPECT_EQ(aligned(walk, one, kWays[0]), std::vector<double>{0});
}

TEST(AlignMap, LongMotionsTakeASecondOrTwo) {
  const Motion walk = examples::make_walk({.num_frames = 20'000});
  const Motion other = examples::make_walk({.num_frames = 18'000, .steps_per_second = 2});
  for (const auto by : kWays) {
    const auto start = std::chrono::steady_clock::now();
    expect_rise(aligned(other, walk, by), 18'000);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    RecordProperty("seconds", std::to_string(time.count()));
  }
}

TEST(AlignMap, FramesThatAreNotFiniteDoNotMatter) {
  const Motion walk = examples::make_walk({.num_frames = 100});
  Motion broken = walk;
  for (double& value : broken.clip.mutate()[50]) value = std::numeric_limits<double>::quiet_NaN();
  for (const auto by : kWays) {
    const auto frames = aligned(broken, walk, by);
    expect_rise(frames, 100);
    for (std::size_t n = 0; n < frames.size(); ++n) EXPECT_NEAR(frames[n], double(n), 2);
  }
}

TEST(AlignMap, NeedsSharedJointsAndFrames) {
  const Motion walk = examples::make_walk({.num_frames = 10});
  Motion other = walk;
  for (Joint& joint : other.skeleton.joints) joint.name += "'";
  auto map = retime::align_map(walk, other, {}, test::ignored());
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().code, "RTM004");
  EXPECT_EQ(map.error().kind, ErrorKind::Usage);
  map = retime::align_map(walk, shown_by(walk, {}), {}, test::ignored());
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().code, "RTM004");
}

TEST(AlignSequences, TakesTheCheapestWay) {
  const std::vector<double> rows = {0, 1, 2, 2, 2, 3, 4};
  const std::vector<double> columns = {0, 0, 1, 2, 3, 4, 4};
  double total = 0;
  const auto way = retime::align_sequences(
      rows.size(), columns.size(),
      [&](std::size_t r, std::size_t c) { return std::abs(rows[r] - columns[c]); });
  for (const auto pair : way) total += std::abs(rows[pair.row] - columns[pair.column]);
  EXPECT_EQ(total, 0);
}

TEST(AlignSequences, RunsNoLongerThanThreeStraightSteps) {
  // Everything in the second belongs to the first frame of the other, but for its last.
  const auto way = retime::align_sequences(
      20, 20, [](std::size_t r, std::size_t c) { return r == 0 || c == 19 ? 0.0 : 1.0; });
  std::size_t run = 0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const bool is_straight = way[i].row == way[i - 1].row || way[i].column == way[i - 1].column;
    const bool goes_on =
        i > 1 && is_straight &&
        ((way[i].row == way[i - 1].row && way[i - 1].row == way[i - 2].row) ||
         (way[i].column == way[i - 1].column && way[i - 1].column == way[i - 2].column));
    run = !is_straight ? 0 : goes_on ? run + 1 : 1;
    EXPECT_LE(run, 3u) << i;
  }
  EXPECT_EQ(way.front().row, 0u);
  EXPECT_EQ(way.back().column, 19u);
}

}  // namespace
}  // namespace kinefile
