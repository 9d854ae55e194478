// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "kinefile/compare.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/shape.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

std::vector<double> column_of(const Motion& motion, std::size_t column) {
  std::vector<double> values;
  for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
    values.push_back(motion.clip.row(f)[column]);
  }
  return values;
}

/// The columns of joint A's three rotations, x about z, y about x, z about y.
Motion motion_of_triples(const std::vector<std::string>& triples) {
  std::vector<std::string> rows;
  for (const std::string& triple : triples) rows.push_back("0 0 0 0 0 0 " + triple);
  return test::motion_of(test::bvh_with_rows(rows));
}

TEST(Unwrapped, TakesOutWholeTurns) {
  const Motion motion = motion_of_triples({"170 0 0", "-170 0 1", "-150 0 2", "730 0 3"});
  const Motion smooth = edit::unwrap(motion);
  EXPECT_EQ(column_of(smooth, 6), (std::vector<double>{170, 190, 210, 10 + 360}));
  EXPECT_EQ(column_of(smooth, 8), (std::vector<double>{0, 1, 2, 3}));
}

TEST(Unwrapped, TakesTheOtherTripleWhereThatIsNearer) {
  const Motion motion = motion_of_triples({"10 80 20", "-170 89 -160", "9 83 21"});
  const Motion smooth = edit::unwrap(motion);
  EXPECT_EQ(column_of(smooth, 6), (std::vector<double>{10, 10, 9}));
  EXPECT_EQ(column_of(smooth, 7), (std::vector<double>{80, 91, 83}));
  EXPECT_EQ(column_of(smooth, 8), (std::vector<double>{20, 20, 21}));
  EXPECT_LT(compare_motions(motion, smooth).rotation.value, 1e-12);
}

TEST(Unwrapped, TakesTheOtherTripleOfProperEulerAngles) {
  std::string text = test::bvh_with_rows(
      {"0 0 0 0 0 0 10 20 30", "0 0 0 0 0 0 190 -21 210", "0 0 0 0 0 0 11 22 30"});
  text.replace(text.rfind("Zrotation Xrotation Yrotation"), 29, "Zrotation Xrotation Zrotation");
  ReadOptions lenient;
  lenient.lenient = true;
  const auto read = test::read_bvh(text, lenient);
  const Motion smooth = edit::unwrap(read.motion());
  EXPECT_EQ(column_of(smooth, 7), (std::vector<double>{20, 21, 22}));
  EXPECT_LT(compare_motions(read.motion(), smooth).rotation.value, 1e-12);
}

TEST(Unwrapped, KeepsEveryBitOfWhatDoesNotJump) {
  const Motion walk = examples::make_walk({.num_frames = 60});
  EXPECT_EQ(edit::unwrap(walk).clip.values, walk.clip.values);
}

TEST(Unwrapped, PlacesTheSame) {
  const Motion walk = examples::make_walk({.num_frames = 400, .frame_rate = 5});
  const Motion smooth = edit::unwrap(walk);
  EXPECT_NE(smooth.clip.values, walk.clip.values);
  EXPECT_LT(compare_motions(walk, smooth).distance.value, 1e-10);
}

TEST(Unwrapped, LeavesPositionsAndFramesThatAreNotFinite) {
  Motion motion = motion_of_triples({"170 0 0", "0 0 0", "-170 0 0"});
  motion.clip.mutate()[1][6] = std::nan("");
  motion.clip.mutate()[2][0] = 5000;
  const Motion smooth = edit::unwrap(motion);
  EXPECT_TRUE(std::isnan(smooth.clip.row(1)[6]));
  EXPECT_EQ(smooth.clip.row(2)[6], 190);
  EXPECT_EQ(smooth.clip.row(2)[0], 5000);
}

TEST(Unwrapped, ContinuesRadiansAndFreeRotations) {
  Motion motion;
  motion.skeleton.angle_unit = AngleUnit::Radians;
  motion.skeleton.joints.resize(2);
  motion.skeleton.joints[0].dofs = {{DofKind::Free, Vec3::UnitX(), 0, 0}};
  motion.skeleton.joints[1].parent = 0;
  motion.skeleton.joints[1].dofs = {{DofKind::Rotation, Vec3::UnitX(), 7, 0}};
  motion.skeleton.coordinates.resize(8);
  motion.clip.num_frames = 2;
  motion.clip.num_coordinates = 8;
  motion.clip.values = {0, 0, 0, 1, 0, 0, 0, 3, 0, 0, 0, -1, 0.1, 0, 0, -3};
  const Motion smooth = edit::unwrap(motion);
  EXPECT_EQ(smooth.clip.row(1)[3], 1);
  EXPECT_EQ(smooth.clip.row(1)[4], -0.1);
  EXPECT_NEAR(smooth.clip.row(1)[7], 2 * std::numbers::pi - 3, 1e-12);
}

TEST(Unwrapped, NeedsNoFramesAndNoColumns) {
  EXPECT_EQ(edit::unwrap(Motion{}).clip.num_frames, 0u);
  EXPECT_EQ(edit::unwrap(examples::make_walk({.num_frames = 0})).clip.num_frames, 0u);
}

}  // namespace
}  // namespace kinefile
