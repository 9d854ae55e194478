// SPDX-License-Identifier: MIT
#include "kinefile/compare.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinefile/kinematics.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

TEST(CompareMotions, AMotionAgreesWithItself) {
  const Motion walk = examples::make_walk({.num_frames = 600});
  const MotionComparison comparison = compare_motions(walk, walk);
  EXPECT_EQ(comparison.distance.value, 0);
  EXPECT_EQ(comparison.tip_distance.value, 0);
  EXPECT_EQ(comparison.rotation.value, 0);
  EXPECT_TRUE(comparison.only_in_first.empty());
}

TEST(CompareMotions, FramesOfOneRateBelongTogetherHoweverItIsSpelt) {
  // Over so many frames the exact rates are half a frame apart.
  Motion walk = examples::make_walk({.num_frames = 60'000, .frame_rate = 30});
  walk.clip.timeline.given = FrameRate{30};
  Motion other = walk;
  other.clip.timeline.given = FrameRate{30.0003};
  EXPECT_EQ(compare_motions(walk, other).distance.value, 0);
}

TEST(CompareMotions, FramesAreFoundByTheirTimesInWhateverOrder) {
  const Motion walk = examples::make_walk({.num_frames = 6});
  Motion mixed = walk;
  mixed.clip.timeline.given = FrameTimes{{0.5, 0.1, 0.2, 0, 0.4, 0.3}};
  Motion sorted = walk;
  sorted.clip.timeline.given = FrameTimes{{0, 0.1, 0.2, 0.3, 0.4, 0.5}};
  const Rows rows = sorted.clip.mutate();
  const std::size_t frame_of[] = {3, 1, 2, 5, 4, 0};
  for (std::size_t f = 0; f < 6; ++f) {
    const auto row = walk.clip.row(frame_of[f]);
    std::copy(row.begin(), row.end(), rows[f].begin());
  }
  EXPECT_EQ(compare_motions(mixed, sorted).distance.value, 0);
  EXPECT_EQ(compare_motions(sorted, mixed).distance.value, 0);
  EXPECT_GT(compare_motions(walk, mixed).distance.value, 0);
}

TEST(CompareMotions, ATimeThatWasCutOffDoesNotDriftAway) {
  Motion cut = examples::make_walk({.num_frames = 2});
  cut.clip.num_frames = 200000;  // of which all but the last are alike
  cut.clip.values.resize(cut.clip.num_frames * cut.clip.num_coordinates);
  const Rows rows = cut.clip.mutate();
  for (std::size_t f = 0; f < cut.clip.num_frames; ++f) {
    std::fill(rows[f].begin(), rows[f].end(), f + 1 == cut.clip.num_frames ? 20.0 : 0.0);
  }
  cut.clip.timeline.given = FrameTime{0.0083333};
  Motion exact = cut;
  exact.clip.timeline.given = FrameRate{120};
  EXPECT_EQ(compare_motions(cut, exact).distance.value, 0);
}

TEST(CompareMotions, LengthsAreInTheFirstMotionsUnit) {
  Motion metres = examples::make_walk({.num_frames = 5});
  Motion feet = metres;
  metres.skeleton.metres_per_unit = 1;
  feet.skeleton.metres_per_unit = 0.25;
  const MotionComparison comparison = compare_motions(metres, feet);
  const WorldPoses poses = forward_kinematics(metres.skeleton, metres.clip);
  double furthest = 0;
  for (std::size_t i = 0; i < poses.positions.size(); i += 3) {
    furthest = std::max(furthest, Vec3(&poses.positions[i]).norm());
  }
  EXPECT_NEAR(comparison.distance.value, 0.75 * furthest, 1e-9);
  feet.skeleton.metres_per_unit = 0;  // unknown: as they are
  EXPECT_EQ(compare_motions(metres, feet).distance.value, 0);
}

TEST(CompareMotions, SaysWhereAndWhenTheyDiffer) {
  const Motion a = test::motion_of(test::bvh_with_rows({"0 0 0 0 0 0 0 0 0", "0 0 0 0 0 0 0 0 0"}));
  Motion b = a;
  b.clip.mutate()[1][3] = 90;
  const MotionComparison comparison = compare_motions(a, b);
  EXPECT_EQ(comparison.rotation.joint, "Hips");
  EXPECT_NEAR(comparison.rotation.value, 90, 1e-12);
  EXPECT_EQ(comparison.distance.joint, "A");
  EXPECT_EQ(comparison.distance.frame, 1u);
  EXPECT_EQ(comparison.distance.time, 0.04);
  EXPECT_NEAR(comparison.distance.value, std::sqrt(10.0), 1e-15);
  EXPECT_EQ(comparison.tip_distance.joint, "A.tip");
}

TEST(CompareMotions, MatchesTimesAndNotFrames) {
  const Motion slow = examples::make_walk({.num_frames = 31, .frame_rate = 30});
  const Motion fast = examples::make_walk({.num_frames = 121, .frame_rate = 120});
  const MotionComparison comparison = compare_motions(slow, fast);
  EXPECT_LT(comparison.distance.value, 2e-6) << "values are rounded to six decimals";
  EXPECT_EQ(comparison.num_frames_first, 31u);
  EXPECT_EQ(comparison.num_frames_second, 121u);
}

TEST(CompareMotions, NamesJointsThatOneOfThemLacks) {
  const Motion walk = examples::make_walk({.num_frames = 2});
  Motion other = walk;
  other.skeleton.joints[5].name = "Skull";
  const MotionComparison comparison = compare_motions(walk, other);
  EXPECT_EQ(comparison.only_in_first, std::vector<std::string>{"Head"});
  EXPECT_EQ(comparison.only_in_second, std::vector<std::string>{"Skull"});
}

TEST(CompareMotions, NanAgreesWithNanAlone) {
  const Motion a = test::motion_of(test::bvh_with_rows({"0 0 0 0 0 0 0 0 0"}));
  Motion b = a;
  b.clip.values.mutate()[0] = NAN;
  EXPECT_EQ(compare_motions(b, b).distance.value, 0);
  EXPECT_EQ(compare_motions(a, b).distance.value, INFINITY);
}

TEST(CompareMotions, EmptyMotionsHaveNothingToCompare) {
  Motion walk = examples::make_walk({.num_frames = 3});
  const Motion empty = examples::make_walk({.num_frames = 0});
  EXPECT_EQ(compare_motions(walk, empty).distance.joint, "");
  EXPECT_EQ(compare_motions(empty, walk).num_frames_second, 3u);
  Motion longer = empty;
  longer.skeleton.joints[1].offset[1] += 2;
  EXPECT_EQ(compare_motions(empty, longer).distance.value, 2);
}

}  // namespace
}  // namespace kinefile
