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

TEST(FindSuddenTurns, AWholeTurnIsNone) {
  EXPECT_TRUE(find_sudden_turns(walk_with_head(40, {13, 20, 21}, 360)).empty());
  EXPECT_TRUE(find_sudden_turns(walk_with_head(40, {13}, 80)).empty());
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
