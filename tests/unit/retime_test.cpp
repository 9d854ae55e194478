// SPDX-License-Identifier: MIT
#include "kinefile/retime.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinefile/joint_rotation.hpp"
#include "support/motions.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

using test::constant_rate;
using test::retimed;
using test::turning_motion;

constexpr retime::RotationInterpolation kEvery[] = {
    retime::RotationInterpolation::Slerp, retime::RotationInterpolation::Nlerp,
    retime::RotationInterpolation::Cubic, retime::RotationInterpolation::Euler};

TEST(Retime, TheIdentityKeepsEveryBit) {
  const Motion walk = examples::make_walk({.num_frames = 100});
  for (const retime::RotationInterpolation rotation : kEvery) {
    for (const bool antialias : {false, true}) {
      const Motion same =
          retimed(walk, constant_rate(100, 1), {.rotation = rotation, .antialias = antialias});
      EXPECT_EQ(same.clip.values, walk.clip.values);
    }
  }
}

TEST(Retime, WholeFramesKeepEveryBitInAnyOrder) {
  const Motion walk = examples::make_walk({.num_frames = 60});
  const retime::TimeMap map{{7, 7.5, 59, 0, 58.25, 7, 12, 31.125, 30}};
  for (const retime::RotationInterpolation rotation : kEvery) {
    const Motion mixed = retimed(walk, map, {.rotation = rotation});
    for (const std::size_t n : {0u, 2u, 3u, 5u, 6u, 8u}) {
      const auto row = mixed.clip.row(n);
      const auto old = walk.clip.row(static_cast<std::size_t>(map.old_frames[n]));
      EXPECT_TRUE(std::equal(row.begin(), row.end(), old.begin())) << n;
    }
  }
}

TEST(Retime, ValuesBeyondTheEndsAreTheEnds) {
  const Motion walk = examples::make_walk({.num_frames = 5});
  const Motion ends = retimed(walk, {{-3, 4.5, 1e300, 4}});
  const auto same = [&](std::size_t n, std::size_t f) {
    return std::equal(ends.clip.row(n).begin(), ends.clip.row(n).end(), walk.clip.row(f).begin());
  };
  EXPECT_TRUE(same(0, 0));
  EXPECT_TRUE(same(1, 4));
  EXPECT_TRUE(same(2, 4));
  EXPECT_TRUE(same(3, 4));
}

TEST(Retime, OneFrameCanBeHeldAndNoneGivesNone) {
  Motion one = examples::make_walk({.num_frames = 1});
  for (const retime::RotationInterpolation rotation : kEvery) {
    const Motion held = retimed(one, {{0, 0, 0.5}}, {.rotation = rotation, .antialias = true});
    ASSERT_EQ(held.clip.num_frames, 3u);
    for (std::size_t n = 0; n < 3; ++n) {
      EXPECT_TRUE(
          std::equal(held.clip.row(n).begin(), held.clip.row(n).end(), one.clip.values.begin()));
    }
  }
  one.clip.num_frames = 0;
  one.clip.values.clear();
  EXPECT_EQ(retimed(one, {}).clip.num_frames, 0u);
  EXPECT_EQ(retimed(examples::make_walk({.num_frames = 3}), {}).clip.num_frames, 0u);
}

TEST(Retime, TheTimelineIsTheMapsOrTheOldOneWithoutTimes) {
  Motion walk = examples::make_walk({.num_frames = 3});
  walk.clip.timeline.given = FrameTimes{{0, 0.1, 0.3}, 25};
  const Motion kept = retimed(walk, {{0, 1.5}});
  EXPECT_EQ(kept.clip.timeline, (Timeline{FrameRate{25}, 0}));
  const Timeline other{FrameTimes{{0, 7}, 4}, 0};
  const Motion given = retimed(walk, {{0, 1.5}, other});
  EXPECT_EQ(given.clip.timeline, other);
}

TEST(Retime, NumbersLieOnTheStraightLine) {
  const Motion motion = test::motion_of(
      test::bvh_with_rows({"1 2 3 0 0 0 0 0 0", "2 2 -1 0 0 0 0 0 0", "0.1 0.7 1e9 0 0 0 0 0 0"}));
  const Motion half = retimed(motion, {{0.25, 0.75, 1.5}});
  EXPECT_EQ(half.clip.row(0)[0], 1.25);
  EXPECT_EQ(half.clip.row(0)[1], 2);
  EXPECT_EQ(half.clip.row(1)[2], 0);
  EXPECT_EQ(half.clip.row(2)[2], -1 + 0.5 * (1e9 + 1));
}

TEST(Retime, CubicNumbersFollowAParabolaAndLeaveTheEndsStraight) {
  std::vector<std::string> rows;
  for (int f = 0; f < 6; ++f) rows.push_back(std::to_string(f * f) + " 5 0.1 0 0 0 0 0 0");
  const Motion curve = retimed(test::motion_of(test::bvh_with_rows(rows)), {{1.5, 2.25, 3.75}},
                               {.rotation = retime::RotationInterpolation::Cubic});
  EXPECT_NEAR(curve.clip.row(0)[0], 1.5 * 1.5, 1e-14);
  EXPECT_NEAR(curve.clip.row(1)[0], 2.25 * 2.25, 1e-14);
  EXPECT_NEAR(curve.clip.row(2)[0], 3.75 * 3.75, 1e-14);
  EXPECT_EQ(curve.clip.row(2)[1], 5);
  EXPECT_EQ(curve.clip.row(2)[2], 0.1) << "equal numbers give themselves";
}

TEST(Retime, AFullTurnWithinAFrameIsNotLost) {
  // The same rotation at both ends, a turn apart: the nearest to the straight line is kept.
  const Motion motion = turning_motion({Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()},
                                       {{7200, 10, 20}, {7200 + 360, 10, 20}});
  const Motion half = retimed(motion, {{0.25, 0.75}});
  EXPECT_NEAR(half.clip.row(0)[0], 7200, 1e-9);
  EXPECT_NEAR(half.clip.row(1)[0], 7560, 1e-9);
}

TEST(Retime, AnglesOfThousandsOfDegreesStayNear) {
  std::vector<Vec3> rows;
  for (int f = 0; f < 100; ++f) rows.emplace_back(5000 + 37 * f, 3 * f - 100, -9000 - 25 * f);
  for (const EulerAxes& axes : test::all_euler_axes()) {
    const Motion motion = turning_motion(axes, rows);
    for (const retime::RotationInterpolation rotation : kEvery) {
      const Motion slow = retimed(motion, constant_rate(390, 0.25), {.rotation = rotation});
      EXPECT_LT(test::largest_step(slow.clip), 180);
      EXPECT_NEAR(slow.clip.row(389)[0], 5000 + 37 * 97.25, 180);
    }
  }
}

TEST(Retime, JointsWithTwoRotationsAreInterpolatedAngleByAngle) {
  Motion motion =
      turning_motion({Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()}, {{0, 0, 7}, {20, -30, 7}});
  motion.skeleton.joints[0].dofs.pop_back();
  const Motion half = retimed(motion, {{0.5}});
  EXPECT_EQ(half.clip.row(0)[0], 10);
  EXPECT_EQ(half.clip.row(0)[1], -15);
  EXPECT_EQ(half.clip.row(0)[2], 7) << "a column that nothing reads";
}

TEST(Retime, TwoRotationsAngleByAngleAreAsGoodAsTheNearestToSlerp) {
  // Slerp leaves what two rotations can reach; here both ways are 0.313 degrees from it at most.
  // The angles nearest to it, by least squares, are hardly nearer than those on the straight line.
  std::vector<Vec3> rows;
  for (int f = 0; f < 60; ++f) {
    rows.emplace_back(40 * std::sin(0.3 * f), 60 * std::sin(0.2 * f + 1), 0);
  }
  Motion motion = turning_motion({Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()}, rows);
  motion.skeleton.joints[0].dofs.pop_back();
  const auto rotations = rotations_of(motion.skeleton.joints[0]);
  const Motion slow = retimed(motion, constant_rate(118, 0.5));
  double straight = 0;
  double fitted = 0;
  for (std::size_t n = 1; n < 117; n += 2) {
    const auto rotation = [&](std::span<const double> row) {
      return Quat(rotation_in_row(rotations, row, AngleUnit::Degrees));
    };
    const Quat target =
        slerp(rotation(motion.clip.row(n / 2)), rotation(motion.clip.row(n / 2 + 1)), 0.5);
    const auto row = slow.clip.row(n);
    straight = std::max(straight, angle_between(target, rotation(row)));
    std::vector<double> fit(row.begin(), row.end());
    fitted = std::max(fitted,
                      fit_rotation(rotations, target.toRotationMatrix(), AngleUnit::Degrees, fit));
  }
  RecordProperty("straight_degrees", std::to_string(straight / kRadiansPerDegree));
  RecordProperty("fitted_degrees", std::to_string(fitted / kRadiansPerDegree));
  EXPECT_LT(straight, 1.5 * fitted + 1e-12);
}

TEST(Retime, OtherSetsOfRotationsAreInterpolatedAngleByAngleWithANote) {
  Motion skew =
      turning_motion({Vec3::UnitZ(), Vec3(0.6, 0.8, 0), Vec3::UnitX()}, {{0, 0, 0}, {20, -30, 40}});
  skew.skeleton.joints[0].dofs[1].axis = Vec3(0, 0.6, 0.8);
  Diagnostics diagnostics;
  const auto half = retime::apply(skew, {{0.5, 0.25}}, {}, diagnostics);
  ASSERT_TRUE(half);
  EXPECT_EQ(half->clip.row(0)[1], -15);
  EXPECT_EQ(test::text_of(diagnostics),
            "note[RTM007]: joint 'j' turns about axes that not every rotation can be brought back "
            "to, so its rotation is interpolated number by number\n");
  Diagnostics quiet;
  ASSERT_TRUE(
      retime::apply(skew, {{0.5}}, {.rotation = retime::RotationInterpolation::Euler}, quiet));
  EXPECT_TRUE(quiet.items().empty());
}

TEST(Retime, SharedColumnsAreInterpolatedOnce) {
  Motion motion =
      turning_motion({Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()}, {{0, 0, 0}, {120, -30, 40}});
  Joint mimic;
  mimic.name = "mimic";
  mimic.parent = 0;
  mimic.dofs = {motion.skeleton.joints[0].dofs[1]};
  motion.skeleton.joints.push_back(mimic);
  Diagnostics diagnostics;
  const auto half = retime::apply(motion, {{0.5}}, {}, diagnostics);
  ASSERT_TRUE(half);
  EXPECT_EQ(half->clip.values, (std::vector<double>{60, -15, 20}));
  EXPECT_EQ(test::codes_of(diagnostics), std::vector<std::string>{"RTM007"});
}

TEST(Retime, AFreeJointTurnsTheShortestWayAndKeepsItsSide) {
  const Quat a(Eigen::AngleAxisd(0.3, Vec3::UnitY()));
  const Quat b = a * Quat(Eigen::AngleAxisd(1.2, Vec3(0.6, 0, 0.8)));
  // The first is negated and both are longer than 1.
  const Motion motion =
      test::free_motion({{1, 2, 3, -2 * a.w(), -2 * a.x(), -2 * a.y(), -2 * a.z()},
                         {3, 2, 1, 3 * b.w(), 3 * b.x(), 3 * b.y(), 3 * b.z()}});
  for (const retime::RotationInterpolation rotation : kEvery) {
    const Motion part = retimed(motion, {{0.25}}, {.rotation = rotation});
    const auto row = part.clip.row(0);
    const Quat q(row[3], row[4], row[5], row[6]);
    EXPECT_EQ(row[0], 1.5);
    EXPECT_EQ(row[1], 2);
    EXPECT_NEAR(q.norm(), 1, 1e-15);
    EXPECT_LT(q.dot(a), 0) << "on the side of the frame before";
    const bool is_chord = rotation == retime::RotationInterpolation::Nlerp;
    EXPECT_LT(angle_between(q, slerp(a, b, 0.25)), is_chord ? 0.05 : 1e-15);
  }
}

TEST(Retime, CubicIsBetterThanSlerpOnAWalk) {
  const Motion walk = examples::make_walk({.num_frames = 241});
  const auto error_of = [&walk](retime::RotationInterpolation rotation) {
    return test::leave_out_error(walk, 2, {.rotation = rotation});
  };
  const auto slerp = error_of(retime::RotationInterpolation::Slerp);
  const auto cubic = error_of(retime::RotationInterpolation::Cubic);
  EXPECT_LT(cubic.degrees, 0.5 * slerp.degrees);
  EXPECT_LT(cubic.distance, 0.5 * slerp.distance);
  EXPECT_LT(slerp.degrees, 0.2);
}

TEST(Retime, AntialiasLeavesAMotionThatDoesNotMove) {
  const Motion walk = examples::make_walk({.num_frames = 1});
  const Motion still = retimed(walk, {std::vector<double>(500, 0)});
  for (const double rate : {1.5, 7.3, 100.0}) {
    const Motion fast = retimed(still, constant_rate(4, rate), {.antialias = true});
    for (std::size_t n = 0; n < 4; ++n) {
      for (std::size_t c = 0; c < fast.clip.num_coordinates; ++c) {
        EXPECT_NEAR(fast.clip.row(n)[c], walk.clip.row(0)[c], 1e-12);
      }
    }
  }
}

TEST(Retime, AntialiasKillsWhatAlternates) {
  std::vector<Vec3> angles;
  for (int f = 0; f < 400; ++f) {
    const double side = f % 2 == 0 ? 1 : -1;
    angles.emplace_back(10 + 20 * side, 30 * side, 5 - 10 * side);
  }
  const Motion shaking = turning_motion({Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()}, angles);
  const retime::TimeMap map = constant_rate(66, 6);
  const Motion aliased = retimed(shaking, map);
  const Motion smooth = retimed(shaking, map, {.antialias = true});
  EXPECT_EQ(aliased.clip.row(30)[0], 30);
  for (std::size_t n = 5; n < 60; ++n) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(smooth.clip.row(n)[c], smooth.clip.row(30)[c], 1e-9);
    }
    EXPECT_LT(std::abs(smooth.clip.row(n)[1]), 4);
  }
}

TEST(Retime, AntialiasSparesWhereTheMapIsSlow) {
  const Motion walk = examples::make_walk({.num_frames = 200});
  retime::TimeMap map = constant_rate(100, 0.75);
  for (double frame = 78; frame < 199; frame += 5) map.old_frames.push_back(frame);
  const Motion plain = retimed(walk, map);
  const Motion smooth = retimed(walk, map, {.antialias = true});
  const auto is_same = [&](std::size_t n) {
    return std::equal(plain.clip.row(n).begin(), plain.clip.row(n).end(),
                      smooth.clip.row(n).begin());
  };
  EXPECT_TRUE(is_same(50));
  EXPECT_TRUE(is_same(98));
  EXPECT_FALSE(is_same(110));
}

TEST(Retime, AntialiasOfAnAbsurdRateIsBounded) {
  const Motion walk = examples::make_walk({.num_frames = 20'000});
  retime::TimeMap jumps;
  for (int n = 0; n < 500; ++n) jumps.old_frames.push_back(n % 4 < 2 ? 0 : 19'999);
  const Motion mean = retimed(walk, jumps, {.antialias = true});
  EXPECT_EQ(mean.clip.num_frames, 500u);
  for (const double value : mean.clip.values) ASSERT_TRUE(std::isfinite(value));
}

}  // namespace
}  // namespace kinefile
