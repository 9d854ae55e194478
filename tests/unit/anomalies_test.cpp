// SPDX-License-Identifier: MIT
#include "kinefile/anomalies.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinefile/kinematics.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

/// A walk of `num_frames` in which the head is turned to `degrees` about y in some frames.
Motion walk_with_head(std::size_t num_frames, const std::vector<std::size_t>& frames,
                      double degrees) {
  constexpr std::size_t kHeadY = 3 + 6 * 3 - 1;
  Motion walk = examples::make_walk({.num_frames = num_frames});
  for (const std::size_t f : frames) walk.clip.mutate()[f][kHeadY] += degrees;
  return walk;
}

TEST(FindSuddenTurns, FindsNoneInAWalk) {
  EXPECT_TRUE(find_sudden_turns(examples::make_walk()).empty());
}

TEST(FindSuddenTurns, FindsASpikeOnce) {
  const auto turns = find_sudden_turns(walk_with_head(40, {13}, 170));
  ASSERT_EQ(turns.size(), 1u);
  EXPECT_EQ(turns[0].joint, 5u);
  EXPECT_EQ(turns[0].frame, 13u);
  EXPECT_EQ(turns[0].return_frame, 14u);
  EXPECT_NEAR(turns[0].degrees, 170, 2);
}

TEST(FindSuddenTurns, ASpikeMayLastFiveFrames) {
  const auto spike = find_sudden_turns(walk_with_head(40, {13, 14, 15, 16, 17}, 170));
  ASSERT_EQ(spike.size(), 1u);
  EXPECT_EQ(spike[0].return_frame, 18u);
  const auto flips = find_sudden_turns(walk_with_head(40, {13, 14, 15, 16, 17, 18}, 170));
  ASSERT_EQ(flips.size(), 2u);
  EXPECT_EQ(flips[0].return_frame, 0u);
  EXPECT_EQ(flips[1].frame, 19u);
  EXPECT_EQ(flips[1].return_frame, 0u);
}

/// A head that turns to a side and back, in frames at a rate.
Motion quick_head(double frame_rate) {
  constexpr std::size_t kHeadY = 3 + 6 * 3 - 1;
  Motion walk = examples::make_walk(
      {.num_frames = static_cast<std::size_t>(frame_rate), .frame_rate = frame_rate});
  for (std::size_t f = 0; f < walk.clip.num_frames; ++f) {
    const double seconds = static_cast<double>(f) / frame_rate;
    walk.clip.mutate()[f][kHeadY] += 75 * std::sin(20 * seconds);  // up to 1500 degrees a second
  }
  return walk;
}

TEST(FindSuddenTurns, AQuickTurnIsNoneAtAnyRate) {
  for (const double rate : {5.0, 10.0, 12.5, 15.0, 20.0, 25.0, 30.0, 60.0, 120.0, 1000.0}) {
    EXPECT_TRUE(find_sudden_turns(quick_head(rate)).empty()) << rate;
  }
}

TEST(FindSuddenTurns, BelowThirtyFramesTheSpeedCounts) {
  const auto num_turns = [](double rate, double degrees) {
    Motion walk = walk_with_head(40, {20}, degrees);
    walk.clip.timeline.given = FrameRate{rate};
    return find_sudden_turns(walk).size();
  };
  EXPECT_EQ(num_turns(120, 95), 1u);
  EXPECT_EQ(num_turns(30, 95), 1u);
  EXPECT_EQ(num_turns(20, 95), 0u);
  EXPECT_EQ(num_turns(20, 150), 1u);
  EXPECT_EQ(num_turns(10, 175), 0u);
  Motion gap = walk_with_head(40, {20}, 120);
  std::vector<double> times;
  for (int f = 0; f < 40; ++f) times.push_back(f < 20 ? f / 30.0 : 1 + f / 30.0);
  gap.clip.timeline.given = FrameTimes{times};
  const auto turns = find_sudden_turns(gap);
  ASSERT_EQ(turns.size(), 1u) << "a second passes before frame 20, a thirtieth before 21";
  EXPECT_EQ(turns[0].frame, 21u);
}

TEST(FindSuddenTurns, ASpikeIsSmallerAtHigherRates) {
  const auto turns = [](double rate, std::initializer_list<std::size_t> frames, double degrees) {
    Motion walk = walk_with_head(40, frames, degrees);
    walk.clip.timeline.given = FrameRate{rate};
    return find_sudden_turns(walk).size();
  };
  EXPECT_EQ(turns(120, {20}, 70), 1u);
  EXPECT_EQ(turns(120, {20}, 35), 1u);
  EXPECT_EQ(turns(120, {20}, 25), 0u);
  EXPECT_EQ(turns(60, {20}, 50), 1u);
  EXPECT_EQ(turns(60, {20}, 40), 0u);
  EXPECT_EQ(turns(120, {20, 21}, 70), 1u);
  EXPECT_EQ(turns(120, {20, 21, 22}, 70), 0u) << "as a punch";
}

TEST(FindSuddenTurns, AWholeTurnIsNone) {
  EXPECT_TRUE(find_sudden_turns(walk_with_head(40, {13, 20, 21}, 360)).empty());
  EXPECT_TRUE(find_sudden_turns(walk_with_head(40, {13, 14, 15}, 80)).empty());
}

TEST(FindSuddenTurns, FindsThoseAtTheBordersOfBlocks) {
  const Skeleton skeleton = examples::make_walk({.num_frames = 1}).skeleton;
  const std::size_t block = frames_per_block(skeleton);
  for (std::size_t f = block - 7; f < block + 8; ++f) {
    const auto turns = find_sudden_turns(walk_with_head(block + 20, {f, f + 1}, 150));
    ASSERT_EQ(turns.size(), 1u) << f;
    EXPECT_EQ(turns[0].frame, f);
    EXPECT_EQ(turns[0].return_frame, f + 2);
  }
}

TEST(FindSuddenTurns, SkipsNumbersThatAreNotFinite) {
  Motion walk = walk_with_head(40, {13, 30}, 170);
  walk.clip.mutate()[12][20] = std::nan("");
  walk.clip.mutate()[31][20] = std::nan("");
  const auto turns = find_sudden_turns(walk);
  // Nobody knows how the head came to frame 13: what is seen is that it leaves there.
  ASSERT_EQ(turns.size(), 2u);
  EXPECT_EQ(turns[0].frame, 14u);
  EXPECT_EQ(turns[1].return_frame, 32u);
}

TEST(FindSuddenTurns, NeedsNoFramesAndNoColumns) {
  EXPECT_TRUE(find_sudden_turns(Motion{}).empty());
  EXPECT_TRUE(find_sudden_turns(examples::make_walk({.num_frames = 1})).empty());
  Motion still;
  still.skeleton.joints.resize(1);
  still.clip.num_frames = 3;
  EXPECT_TRUE(find_sudden_turns(still).empty());
}

}  // namespace
}  // namespace kinefile
