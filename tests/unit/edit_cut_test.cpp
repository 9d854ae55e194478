// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "kinefile/edit.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

TEST(Trimmed, KeepsEveryBitAndTheFilesOwnNumbers) {
  Motion walk = examples::make_walk({.num_frames = 10});
  walk.clip.timeline.first_frame_number = 1;
  const auto part = edit::trim(walk, 3, 7);
  ASSERT_TRUE(part);
  EXPECT_EQ(part->clip.num_frames, 4u);
  EXPECT_EQ(part->clip.timeline.first_frame_number, 4);
  const auto begin = walk.clip.values.begin();
  const auto columns = static_cast<std::ptrdiff_t>(walk.clip.num_coordinates);
  EXPECT_EQ(part->clip.values, std::vector<double>(begin + 3 * columns, begin + 7 * columns));
}

TEST(Trimmed, CutsTheTimesOfFrames) {
  Motion walk = examples::make_walk({.num_frames = 4});
  walk.clip.timeline.given = FrameTimes{{0, 0.1, 0.5, 0.6}};
  EXPECT_EQ(own_times(edit::trim(walk, 1, 3)->clip.timeline), (std::vector<double>{0.1, 0.5}));
}

TEST(Trimmed, MayKeepAllFramesOrNone) {
  const Motion walk = examples::make_walk({.num_frames = 5});
  EXPECT_EQ(edit::trim(walk, 0, 5)->clip.values, walk.clip.values);
  EXPECT_EQ(edit::trim(walk, 5, 5)->clip.num_frames, 0u);
}

TEST(Trimmed, RefusesFramesThatAreNotThere) {
  const Motion walk = examples::make_walk({.num_frames = 5});
  const auto refused = edit::trim(walk, 2, 6);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "EDT003");
  EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
  EXPECT_EQ(refused.error().message, "expected frames within 0:5, found 2:6");
  EXPECT_FALSE(edit::trim(walk, 4, 3));
}

TEST(Reversed, TwiceIsTheSameMotion) {
  const Motion walk = examples::make_walk({.num_frames = 7});
  const Motion back = edit::reverse(walk);
  EXPECT_EQ(back.clip.row(0)[5], walk.clip.row(6)[5]);
  EXPECT_EQ(edit::reverse(back).clip.values, walk.clip.values);
}

TEST(Reversed, TurnsTheTimesOfFramesAround) {
  Motion walk = examples::make_walk({.num_frames = 3});
  walk.clip.timeline.given = FrameTimes{{1, 1.5, 3}};
  EXPECT_EQ(own_times(edit::reverse(walk).clip.timeline), (std::vector<double>{1, 2.5, 3}));
}

TEST(Reversed, NeedsNoFramesAndNoColumns) {
  EXPECT_EQ(edit::reverse(Motion{}).clip.num_frames, 0u);
  Motion still;
  still.skeleton.joints.resize(1);
  still.clip.num_frames = 3;
  EXPECT_EQ(edit::reverse(still).clip.num_frames, 3u);
}

}  // namespace
}  // namespace kinefile
