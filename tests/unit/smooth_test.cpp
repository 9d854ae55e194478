// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kinefile/edit.hpp"
#include "kinefile/joint_rotation.hpp"
#include "support/support.hpp"
#include "support/threads.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

constexpr double kRate = 100;

Motion smooth(const Motion& motion, double cutoff_hz) {
  auto result = edit::smooth(motion, cutoff_hz);
  EXPECT_TRUE(result) << to_string(result.error());
  return result ? std::move(*result) : Motion{};
}

/// A root with one rotation and one translation; both columns are filled by a function of time.
template <class Signal>
Motion motion_of_signal(std::size_t num_frames, Signal signal) {
  Motion motion;
  Joint root;
  root.name = "root";
  root.dofs = {{DofKind::Translation, Vec3::UnitX(), 0, 0},
               {DofKind::Rotation, Vec3::UnitZ(), 1, 0}};
  motion.skeleton.joints = {root};
  motion.skeleton.coordinates = {{0, "Xposition"}, {0, "Zrotation"}};
  motion.clip.num_frames = num_frames;
  motion.clip.num_coordinates = 2;
  motion.clip.timeline.given = FrameTime{1 / kRate};
  for (std::size_t f = 0; f < num_frames; ++f) {
    const double value = signal(static_cast<double>(f) / kRate);
    motion.clip.values.append({value, value});
  }
  return motion;
}

auto sine(double hz) {
  return [hz](double time) { return 10 * std::sin(2 * std::numbers::pi * hz * time + 0.3); };
}

TEST(Smoothed, KeepsWhatIsSlowWithoutDelay) {
  const Motion slow = motion_of_signal(400, sine(0.5));
  const Motion same = smooth(slow, 6);
  for (std::size_t f = 0; f < 400; ++f) {
    EXPECT_NEAR(same.clip.row(f)[0], slow.clip.row(f)[0], 0.1) << f;
    EXPECT_NEAR(same.clip.row(f)[1], slow.clip.row(f)[1], 0.1) << f;
  }
}

TEST(Smoothed, RemovesWhatIsFast) {
  const Motion still = smooth(motion_of_signal(400, sine(40)), 3);
  for (std::size_t f = 40; f < 360; ++f) EXPECT_NEAR(still.clip.row(f)[0], 0, 0.01) << f;
}

TEST(Smoothed, HalvesThePowerAtTheCutOff) {
  const Motion half = smooth(motion_of_signal(1000, sine(5)), 5);
  double square = 0;
  for (std::size_t f = 300; f < 700; ++f) square += std::pow(half.clip.row(f)[0], 2);
  EXPECT_NEAR(std::sqrt(square / 400 * 2), 10 / std::numbers::sqrt2, 1e-6);
}

TEST(Smoothed, KeepsWhatDoesNotChangeBitForBit) {
  Motion still = examples::make_walk({.num_frames = 50});
  for (std::size_t f = 1; f < 50; ++f) {
    const auto first = still.clip.row(0);
    std::copy(first.begin(), first.end(), still.clip.mutate()[f].begin());
  }
  EXPECT_EQ(smooth(still, 3).clip.values, still.clip.values);
}

TEST(Smoothed, KeepsStraightLines) {
  const Motion line = motion_of_signal(100, [](double time) { return 3 + 20 * time; });
  const Motion same = smooth(line, 4);
  for (std::size_t f = 0; f < 100; ++f) EXPECT_NEAR(same.clip.row(f)[0], line.clip.row(f)[0], 1e-5);
}

TEST(Smoothed, AnglesThatJumpByATurnStayTheSameRotation) {
  const Motion turning =
      motion_of_signal(200, [](double time) { return std::remainder(300 * time, 360.0); });
  const Motion same = smooth(turning, 5);
  for (std::size_t f = 0; f < 200; ++f) {
    EXPECT_NEAR(same.clip.row(f)[1], turning.clip.row(f)[1], 1e-5) << f;
  }
}

TEST(Smoothed, ThreeRotationsAreSmoothedAsOne) {
  // A yaw that passes 90 degrees of pitch: the angles jump, the rotation does not.
  std::vector<std::string> rows;
  for (int f = 0; f < 60; ++f) {
    const double pitch = 60 + f;
    const bool is_over = pitch > 90;
    rows.push_back("0 0 0 " + std::to_string(is_over ? 180 : 0) + " " +
                   std::to_string(is_over ? 180 - pitch : pitch) + " " +
                   std::to_string(is_over ? 180 : 0) + " 0 0 0");
  }
  const Motion motion = test::motion_of(test::bvh_with_rows(rows));
  const Motion same = smooth(motion, 3);
  const auto rotations = rotations_of(motion.skeleton.joints[0]);
  for (std::size_t f = 0; f < 60; ++f) {
    const Quat before(rotation_in_row(rotations, motion.clip.row(f), AngleUnit::Degrees));
    const Quat after(rotation_in_row(rotations, same.clip.row(f), AngleUnit::Degrees));
    EXPECT_LT(angle_between(before, after) / kRadiansPerDegree, 0.2) << f;
    EXPECT_NEAR(same.clip.row(f)[3], motion.clip.row(f)[3], 2) << f;
  }
}

TEST(Smoothed, TakesSpikesOutOfFreeRotations) {
  Motion motion;
  motion.skeleton.joints.resize(1);
  motion.skeleton.joints[0].dofs = {{DofKind::Free, Vec3::UnitX(), 0, 0}};
  motion.skeleton.coordinates.resize(7, {0, "q"});
  motion.clip.num_frames = 50;
  motion.clip.num_coordinates = 7;
  for (int f = 0; f < 50; ++f) {
    const double sign = f % 2 == 0 ? 1 : -1;  // the same rotation
    const double bump = f == 25 ? 0.2 : 0;
    motion.clip.values.append({1, 2, 3, sign, 0, sign * bump, 0});
  }
  const Motion calm = smooth(motion, 2);
  EXPECT_LT(std::abs(calm.clip.row(25)[5]), 0.05);
  EXPECT_NEAR(std::abs(calm.clip.row(25)[3]), 1, 0.01);
  EXPECT_EQ(calm.clip.row(25)[2], 3);
}

TEST(Smoothed, RefusesACutOffThatThereIsNot) {
  const Motion motion = motion_of_signal(10, sine(1));
  for (const double cutoff : {0.0, -1.0, 50.0, std::nan("")}) {
    const auto refused = edit::smooth(motion, cutoff);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, "EDT007");
    EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
  }
  EXPECT_EQ(edit::smooth(motion, 50).error().message,
            "expected a cut-off between 0 and half the frame rate, 50 Hz, found 50");
}

TEST(Smoothed, RefusesNumbersThatAreNotFinite) {
  Motion motion = motion_of_signal(10, sine(1));
  motion.clip.mutate()[4][1] = std::nan("");
  const auto refused = edit::smooth(motion, 5);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "EDT008");
  EXPECT_EQ(refused.error().kind, ErrorKind::InvalidInput);
  EXPECT_EQ(refused.error().message, "Zrotation of joint 'root' is not finite in frame 4");
}

TEST(Smoothed, FramesHaveToBeEquallyFarApart) {
  Motion motion = motion_of_signal(3, sine(1));
  motion.clip.timeline.given = FrameTimes{{0, 0.1, 0.3}};
  const auto refused = edit::smooth(motion, 1);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "EDT011");
  EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
}

TEST(Smoothed, NeedsFewFramesOrNone) {
  for (const std::size_t count : {0u, 1u, 2u, 3u}) {
    const Motion motion = motion_of_signal(count, sine(1));
    EXPECT_EQ(smooth(motion, 5).clip.num_frames, count);
  }
  EXPECT_EQ(smooth(motion_of_signal(1, sine(1)), 5).clip.values,
            motion_of_signal(1, sine(1)).clip.values);
  EXPECT_EQ(smooth(motion_of_signal(9, sine(1)), 1e-9).clip.num_frames, 9u);
}

TEST(Smoothed, WhatIsSlowerThanTheMotionIsLongComesOutAsTheLineBetweenItsEnds) {
  Motion motion = motion_of_signal(200, sine(1));
  const double first = motion.clip.values.front();
  const double last = motion.clip.values.back();
  const Motion still = smooth(motion, 1e-9);
  for (std::size_t f = 0; f < 200; ++f) {
    const double line = first + (last - first) * static_cast<double>(f) / 199;
    EXPECT_NEAR(still.clip.row(f)[0], line, 1e-6);
  }
}

TEST(Smooth, EveryNumberOfThreadsGivesTheSameBits) {
  const Motion walk = examples::make_walk({.num_frames = 1000});
  const auto smoothed = [&walk](std::size_t threads) {
    const test::Threads some(threads);
    return smooth(walk, 3);
  };
  const Motion alone = smoothed(1);
  for (const std::size_t threads : test::kThreadCounts) {
    EXPECT_EQ(smoothed(threads).clip.values, alone.clip.values);
  }
}

}  // namespace
}  // namespace kinefile
