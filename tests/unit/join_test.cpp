// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kinefile/edit.hpp"
#include "kinefile/joint_rotation.hpp"
#include "kinefile/kinematics.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

std::string refusal_of(const Result<Motion>& result) {
  if (result) return "";
  EXPECT_EQ(result.error().code, "EDT005");
  EXPECT_EQ(result.error().kind, ErrorKind::Usage);
  return result.error().message;
}

Vec3 root_at(const Motion& motion, std::size_t frame) {
  const auto row = motion.clip.row(frame);
  return {row[0], row[1], row[2]};
}

/// How fast the joints move at most from one frame to the next, in units a frame.
double fastest(const Motion& motion, std::size_t begin, std::size_t end) {
  const WorldPoses poses = forward_kinematics(motion.skeleton, motion.clip);
  double largest = 0;
  for (std::size_t f = begin + 1; f < end; ++f) {
    for (std::size_t j = 0; j < poses.num_joints; ++j) {
      const double* now = &poses.positions[(f * poses.num_joints + j) * 3];
      const Vec3 step = Vec3(now) - Vec3(now - poses.num_joints * 3);
      largest = std::max(largest, step.norm());
    }
  }
  return largest;
}

TEST(Appended, KeepsEveryBit) {
  const Motion walk = examples::make_walk({.num_frames = 8});
  const Motion other = examples::make_walk({.num_frames = 3, .steps_per_second = 1});
  const auto both = edit::append(walk, other, 0, test::ignored());
  ASSERT_TRUE(both);
  EXPECT_EQ(both->clip.num_frames, 11u);
  Array<double> values = walk.clip.values;
  values.append(other.clip.values);
  EXPECT_EQ(both->clip.values, values);
}

TEST(Appended, GoesOnWithTheTimesOfFrames) {
  Motion first = examples::make_walk({.num_frames = 2, .frame_rate = 10});
  const Motion second = first;
  first.clip.timeline.given = FrameTimes{{1, 1.25}};
  const auto both = edit::append(first, second, 0, test::ignored());
  ASSERT_TRUE(both);
  const Array<double>& times = own_times(both->clip.timeline);
  ASSERT_EQ(times.size(), 4u);
  EXPECT_EQ(times[1], 1.25);
  EXPECT_DOUBLE_EQ(times[2], 1.5);  // the median step of the first
  EXPECT_DOUBLE_EQ(times[3], 1.6);
  const auto faded = edit::append(first, second, 1, test::ignored());
  ASSERT_EQ(own_times(faded->clip.timeline).size(), 3u);
  EXPECT_DOUBLE_EQ(own_times(faded->clip.timeline)[2], 1.35);
}

TEST(Looped, GoesOnByTheMedianStepOfTheFramesOwnTimes) {
  Motion walk = examples::make_walk({.num_frames = 3});
  walk.clip.timeline.given = FrameTimes{{0, 0.5, 0.75}};
  const auto twice = edit::loop(walk, 2, 0, test::ignored());
  ASSERT_TRUE(twice);
  EXPECT_EQ(own_times(twice->clip.timeline), (std::vector<double>{0, 0.5, 0.75, 1, 1.5, 1.75}));
}

TEST(Appended, FadesOneIntoTheOther) {
  const Motion walk = examples::make_walk({.num_frames = 120});
  const auto both = edit::append(walk, walk, 30, test::ignored());
  ASSERT_TRUE(both);
  EXPECT_EQ(both->clip.num_frames, 210u);
  const auto first = both->clip.row(89);
  EXPECT_TRUE(std::equal(first.begin(), first.end(), walk.clip.row(89).begin()));
  // No joint moves much faster than it does anyway, where a jump would be metres long.
  EXPECT_LT(fastest(*both, 85, 125), 2 * fastest(walk, 0, 120));
  // The second goes on from where the first is, and as far.
  const Vec3 way = root_at(walk, 119) - root_at(walk, 30);
  const Vec3 way_on = root_at(*both, 209) - root_at(*both, 120);
  EXPECT_NEAR(way_on.norm(), way.norm(), 0.01);
  EXPECT_GT(root_at(*both, 209).norm(), 1.5 * root_at(walk, 119).norm());
  EXPECT_NEAR(root_at(*both, 209)[1], root_at(walk, 119)[1], 1e-12);
}

TEST(Appended, TurnsTheSecondOnTheGround) {
  const Motion first = test::motion_of(test::bvh_with_rows({"5 1 0 0 0 90 0 0 0"}));
  const Motion second = test::motion_of(
      test::bvh_with_rows({"0 1 0 0 0 0 0 0 0", "0 1 2 0 0 0 0 0 0", "0 1 4 0 0 10 0 0 0"}));
  const auto both = edit::append(first, second, 1, test::ignored());
  ASSERT_TRUE(both);
  ASSERT_EQ(both->clip.num_frames, 3u);
  EXPECT_LT((root_at(*both, 0) - Vec3(5, 1, 0)).norm(), 1e-12);
  EXPECT_LT((root_at(*both, 1) - Vec3(7, 1, 0)).norm(), 1e-12);
  EXPECT_LT((root_at(*both, 2) - Vec3(9, 1, 0)).norm(), 1e-12);
  EXPECT_NEAR(both->clip.row(2)[5], 100, 1e-12);
}

TEST(Appended, SlerpsHalfway) {
  const auto rows = [](const char* a) { return test::motion_of(test::bvh_with_rows({a})); };
  const auto both =
      edit::append(rows("0 0 0 0 0 0 80 0 0"), rows("0 0 0 0 0 0 0 60 0"), 1, test::ignored());
  ASSERT_TRUE(both);
  const auto rotations = rotations_of(both->skeleton.joints[1]);
  const Quat half = slerp(Quat(Eigen::AngleAxisd(80 * kRadiansPerDegree, Vec3::UnitZ())),
                          Quat(Eigen::AngleAxisd(60 * kRadiansPerDegree, Vec3::UnitX())), 0.5);
  const Quat found(rotation_in_row(rotations, both->clip.row(0), AngleUnit::Degrees));
  EXPECT_LT(angle_between(half, found), 1e-12);
}

TEST(Appended, RefusesOtherSkeletonsAndTellsTheFirstDifference) {
  const Motion walk = examples::make_walk({.num_frames = 2});
  Motion other = walk;
  other.skeleton.joints[3].name = "Thorax";
  EXPECT_EQ(refusal_of(edit::append(walk, other, 0, test::ignored())),
            "the skeletons differ: joint 'Chest' is called 'Thorax' there");
  other = walk;
  other.skeleton.joints[4].offset[1] += 0.1;
  EXPECT_EQ(refusal_of(edit::append(walk, other, 0, test::ignored())),
            "the skeletons differ: joint 'Neck' has another offset");
  other.skeleton.joints[4].offset[1] -= 0.1 - 1e-5;
  Diagnostics diagnostics;
  EXPECT_EQ(refusal_of(edit::append(walk, other, 0, diagnostics)), "");
  EXPECT_EQ(test::codes_of(diagnostics), std::vector<std::string>{});
  other.skeleton.joints[4].offset[1] += 0.01;  // of a skeleton of 260: exporters round
  EXPECT_EQ(refusal_of(edit::append(walk, other, 0, diagnostics)), "");
  EXPECT_EQ(test::codes_of(diagnostics), std::vector<std::string>{"EDT014"});
  other.skeleton.joints[4].offset = walk.skeleton.joints[4].offset;
  other = walk;
  other.skeleton.joints[0].dofs[0].rest = 7;
  EXPECT_EQ(refusal_of(edit::append(walk, other, 0, test::ignored())), "");
  other.skeleton.joints[5].dofs.pop_back();
  EXPECT_EQ(refusal_of(edit::append(walk, other, 0, test::ignored())),
            "the skeletons differ: joint 'Head' moves in other ways");
  other = walk;
  other.skeleton.coordinates[0].channel = "x";
  EXPECT_EQ(refusal_of(edit::append(walk, other, 0, test::ignored())),
            "the skeletons differ: their columns differ");
}

TEST(Appended, RefusesOtherRatesAndTooLongFades) {
  const Motion walk = examples::make_walk({.num_frames = 5, .frame_rate = 50});
  const Motion slow = examples::make_walk({.num_frames = 9, .frame_rate = 25});
  EXPECT_EQ(refusal_of(edit::append(walk, slow, 0, test::ignored())),
            "the frame rates differ: 50 and 25 frames a second");
  EXPECT_EQ(refusal_of(edit::append(walk, walk, 6, test::ignored())),
            "6 frames cannot be blended where a motion has 5");
}

TEST(Appended, ARateMayBeSpeltInSeveralWays) {
  Motion all = examples::make_walk({.num_frames = 5, .frame_rate = 30});
  all.clip.timeline.given = FrameTime{0.0333333};
  const Motion first = all;
  for (const double seconds : {0.033333, 0.03333323, 1.0 / 30}) {
    Motion next = first;
    next.clip.timeline.given = FrameTime{seconds};
    auto joined = edit::append(std::move(all), next, 0, test::ignored());
    ASSERT_TRUE(joined) << seconds;
    all = std::move(*joined);
  }
  EXPECT_EQ(all.clip.num_frames, 20u);
  EXPECT_EQ(all.clip.timeline, first.clip.timeline);
  Motion slower = first;
  slower.clip.timeline.given = FrameTime{0.0333667};
  EXPECT_EQ(refusal_of(edit::append(all, slower, 0, test::ignored())),
            "the frame rates differ: 30 and 29.97002997002997 frames a second");
}

TEST(Looped, KeepsEveryBit) {
  const Motion walk = examples::make_walk({.num_frames = 4});
  const auto thrice = edit::loop(walk, 3, 0, test::ignored());
  ASSERT_TRUE(thrice);
  EXPECT_EQ(thrice->clip.num_frames, 12u);
  for (std::size_t f = 0; f < 12; ++f) {
    const auto row = thrice->clip.row(f);
    EXPECT_TRUE(std::equal(row.begin(), row.end(), walk.clip.row(f % 4).begin()));
  }
  EXPECT_EQ(edit::loop(walk, 1, 0, test::ignored())->clip.values, walk.clip.values);
}

TEST(Looped, WalksOnWhenBlended) {
  const Motion walk = examples::make_walk({.num_frames = 120});
  const auto far = edit::loop(walk, 4, 20, test::ignored());
  ASSERT_TRUE(far);
  EXPECT_EQ(far->clip.num_frames, 420u);
  EXPECT_LT(fastest(*far, 0, 420), 2 * fastest(walk, 0, 120));
}

TEST(Looped, AnglesThatAreWholeTurnsApartAtTheSeamDoNotJump) {
  Motion walk = examples::make_walk({.num_frames = 60});
  for (std::size_t f = 0; f < 60; ++f) {  // every angle winds up by a whole turn over the clip
    const auto row = walk.clip.mutate()[f];
    for (std::size_t c = 3; c < row.size(); ++c) row[c] += 360 * static_cast<double>(f) / 59;
  }
  const auto twice = edit::loop(walk, 2, 10, test::ignored());
  ASSERT_TRUE(twice);
  double largest = 0;
  for (std::size_t f = 1; f < twice->clip.num_frames; ++f) {
    for (std::size_t c = 3; c < twice->clip.num_coordinates; ++c) {
      largest = std::max(largest, std::abs(twice->clip.row(f)[c] - twice->clip.row(f - 1)[c]));
    }
  }
  EXPECT_LT(largest, 180);
}

TEST(Looped, RefusesNoneAndTooMany) {
  const Motion walk = examples::make_walk({.num_frames = 4});
  EXPECT_EQ(refusal_of(edit::loop(walk, 0, 0, test::ignored())),
            "a motion cannot be played 0 times");
  EXPECT_EQ(
      refusal_of(edit::loop(walk, std::numeric_limits<std::size_t>::max(), 0, test::ignored())),
      "the motion would have more than 2^30 values");
  EXPECT_EQ(refusal_of(edit::loop(walk, 2, 5, test::ignored())),
            "5 frames cannot be blended where a motion has 4");
}

TEST(Looped, NeedsNoFramesAndNoColumns) {
  EXPECT_EQ(edit::loop(examples::make_walk({.num_frames = 0}), 1000000000, 0, test::ignored())
                ->clip.num_frames,
            0u);
  Motion still;
  still.skeleton.joints.resize(1);
  still.clip.num_frames = 2;
  EXPECT_EQ(edit::loop(still, 3, 1, test::ignored())->clip.num_frames, 4u);
}

TEST(Looped, OneFrameAndNumbersThatAreNotFinite) {
  Motion walk = examples::make_walk({.num_frames = 1});
  EXPECT_EQ(edit::loop(walk, 3, 1, test::ignored())->clip.num_frames, 1u);
  walk.clip.mutate()[0][5] = std::nan("");
  EXPECT_EQ(edit::loop(walk, 3, 1, test::ignored())->clip.num_frames, 1u);
  EXPECT_EQ(edit::loop(walk, 3, 0, test::ignored())->clip.num_frames, 3u);
}

}  // namespace
}  // namespace kinefile
