// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "kinefile/bvh.hpp"
#include "kinefile/compare.hpp"
#include "kinefile/shape.hpp"
#include "support/motion_checks.hpp"
#include "support/support.hpp"
#include "support/threads.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

Motion changed(const Motion& motion, const shape::ChannelOptions& options) {
  Diagnostics diagnostics;
  auto result = shape::with_channels(motion, options, diagnostics);
  EXPECT_TRUE(result) << to_string(result.error());
  EXPECT_TRUE(validate(result->skeleton));
  return result ? std::move(*result) : Motion{};
}

std::string channels_of(const Motion& motion, std::size_t joint) {
  std::string text;
  for (const Coordinate& coordinate : motion.skeleton.coordinates) {
    if (coordinate.joint == joint) text += coordinate.channel + " ";
  }
  return text;
}

double distance(const Motion& a, const Motion& b) {
  const MotionComparison comparison = compare_motions(a, b);
  return std::max(comparison.distance.value, comparison.tip_distance.value);
}

double largest_step(const Clip& clip) {
  double largest = 0;
  for (std::size_t f = 1; f < clip.num_frames; ++f) {
    for (std::size_t c = 3; c < clip.num_coordinates; ++c) {
      largest = std::max(largest, std::abs(clip.row(f)[c] - clip.row(f - 1)[c]));
    }
  }
  return largest;
}

/// A root that slides and turns on, and a joint with channels of its own for all but x.
constexpr char kMixed[] =
    "HIERARCHY\nROOT r\n{\nOFFSET 1 2 3\nCHANNELS 4 Yposition Zrotation Yrotation Xrotation\n"
    "JOINT a\n{\nOFFSET 4 5 6\nCHANNELS 3 Zposition Yposition Zrotation\n"
    "JOINT b\n{\nOFFSET 0 7 0\nCHANNELS 2 Zrotation Xscale\nEnd Site\n{\nOFFSET 1 1 1\n}\n}\n}\n}\n"
    "MOTION\nFrames: 3\nFrame Time: 0.1\n"
    "9 10 20 30 6 5 40 50 2\n"
    "8 15 25 35 6 5 45 55 2\n"
    "7 20 30 40 6 5 50 60 2\n";

TEST(WithChannels, EveryOrderPlacesTheSame) {
  const Motion walk = examples::make_walk({.num_frames = 100});
  for (const char* word : {"XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX", "ZXZ", "XYX"}) {
    const Motion other = changed(walk, {.order = shape::parse_rotation_order(word)});
    EXPECT_LT(distance(walk, other), 1e-12) << word;
    EXPECT_LT(largest_step(other.clip), 180) << word;
  }
}

TEST(WithChannels, AnOrderThatIsThereKeepsEveryBit) {
  const Motion walk = examples::make_walk({.num_frames = 50});
  const Motion same = changed(walk, {.order = shape::parse_rotation_order("ZXY")});
  EXPECT_EQ(same.clip.values, walk.clip.values);
}

TEST(WithChannels, TurnsBeyondHalfACircleGoOn) {
  std::vector<std::string> rows;
  for (int f = 0; f < 40; ++f) {
    rows.push_back("0 0 0 10 20 " + std::to_string(f * 30) + " 0 0 0");
  }
  const Motion spin = test::motion_of(test::bvh_with_rows(rows));
  const Motion other = changed(spin, {.order = shape::parse_rotation_order("YXZ")});
  EXPECT_LT(distance(spin, other), 1e-12);
  EXPECT_LT(largest_step(other.clip), 60);
  EXPECT_GT(std::abs(other.clip.row(39)[3] - other.clip.row(0)[3]), 1000);
}

TEST(WithChannels, AFrameThatIsNotFiniteDoesNotSpoilTheNext) {
  const ReadOptions quiet;
  const auto read =
      test::read_bvh(test::bvh_with_rows({"0 0 0 10 20 400 0 0 0", "0 0 0 nan 20 410 0 0 0",
                                          "0 0 0 10 20 420 0 0 0"}),
                     quiet);
  const Motion other = changed(read.motion(), {.order = shape::parse_rotation_order("YXZ")});
  EXPECT_TRUE(std::isnan(other.clip.row(1)[3]));
  EXPECT_FALSE(std::isnan(other.clip.row(2)[3]));
  EXPECT_LT(std::abs(other.clip.row(2)[3] - other.clip.row(0)[3]), 90);
}

TEST(WithChannels, AsIsKeepsPositionsScalesAndSingleRotations) {
  const Motion mixed = test::motion_of(kMixed);
  const Motion other = changed(mixed, {.order = shape::parse_rotation_order("XYZ")});
  EXPECT_EQ(channels_of(other, 0), "Yposition Xrotation Yrotation Zrotation ");
  EXPECT_EQ(channels_of(other, 1), "Zposition Yposition Zrotation ");
  EXPECT_EQ(channels_of(other, 2), "Zrotation Xscale ");
  EXPECT_LT(distance(mixed, other), 1e-12);
}

TEST(WithChannels, AllGivesSixChannelsToEveryJoint) {
  const Motion mixed = test::motion_of(kMixed);
  const Motion all =
      changed(mixed, {.order = std::nullopt, .positions = shape::PositionChannels::All});
  EXPECT_EQ(channels_of(all, 0), "Xposition Yposition Zposition Zrotation Yrotation Xrotation ");
  EXPECT_EQ(channels_of(all, 1), "Xposition Yposition Zposition Zrotation Xrotation Yrotation ");
  EXPECT_EQ(channels_of(all, 2),
            "Xposition Yposition Zposition Zrotation Xrotation Yrotation Xscale ");
  EXPECT_EQ(distance(mixed, all), 0);
}

/// A root that does not move, a slider, and joints with one and two rotations, out of order too.
constexpr char kBare[] =
    "HIERARCHY\nROOT r\n{\nOFFSET 1 2 -3\nCHANNELS 0\n"
    "JOINT slider\n{\nOFFSET 4 5 6\nCHANNELS 1 Yposition\n"
    "JOINT one\n{\nOFFSET 0 7 0\nCHANNELS 1 Yrotation\n"
    "JOINT two\n{\nOFFSET 0 8 0\nCHANNELS 2 Zrotation Xrotation\n"
    "JOINT odd\n{\nOFFSET 0 9 0\nCHANNELS 2 Xrotation Zrotation\n"
    "JOINT fixed\n{\nOFFSET 1 0 0\nCHANNELS 0\nEnd Site\n{\nOFFSET 1 1 1\n}\n}\n}\n}\n}\n}\n}\n"
    "MOTION\nFrames: 2\nFrame Time: 0.1\n"
    "5.5 370.1 -10 0.1 1e-300 700\n"
    "5.25 370.2 -20 0.2 -0 701\n";

TEST(WithChannels, RootAndOwnCompletesWhatIsThereAndKeepsItsBits) {
  const Motion bare = test::motion_of(kBare);
  const Motion whole = changed(bare, {.positions = shape::PositionChannels::RootAndOwn});
  const std::string positions = "Xposition Yposition Zposition ";
  EXPECT_EQ(channels_of(whole, 0), positions + "Zrotation Xrotation Yrotation ");
  EXPECT_EQ(channels_of(whole, 1), positions + "Zrotation Xrotation Yrotation ");
  EXPECT_EQ(channels_of(whole, 2), "Zrotation Xrotation Yrotation ");
  EXPECT_EQ(channels_of(whole, 3), "Zrotation Xrotation Yrotation ");
  EXPECT_EQ(channels_of(whole, 4), "Xrotation Zrotation Yrotation ");
  EXPECT_EQ(channels_of(whole, 5), "");
  EXPECT_TRUE(test::same_bits(whole.clip.row(0),
                              std::vector<double>{1, 2, -3, 0,     0,   0,   4, 5.5,    6,   0, 0,
                                                  0, 0, 0,  370.1, -10, 0.1, 0, 1e-300, 700, 0}));
  EXPECT_TRUE(test::same_bits(whole.clip.row(1),
                              std::vector<double>{1, 2, -3, 0,     0,   0,   4, 5.25, 6,   0, 0,
                                                  0, 0, 0,  370.2, -20, 0.2, 0, -0.0, 701, 0}));
  EXPECT_EQ(distance(bare, whole), 0);
  const Motion ordered = changed(bare, {.order = shape::parse_rotation_order("YXZ"),
                                        .positions = shape::PositionChannels::RootAndOwn});
  EXPECT_EQ(channels_of(ordered, 2), "Yrotation Xrotation Zrotation ");
  EXPECT_EQ(channels_of(ordered, 5), "");
  EXPECT_LT(distance(bare, ordered), 1e-12);
}

TEST(WithChannels, RootAndOwnIsTheSameASecondTime) {
  const shape::ChannelOptions options{.positions = shape::PositionChannels::RootAndOwn,
                                      .distinct_axes = true};
  const Motion once = changed(test::motion_of(kBare), options);
  const Motion twice = changed(once, options);
  EXPECT_TRUE(test::same_skeleton(once.skeleton, twice.skeleton));
  EXPECT_EQ(once.clip.values, twice.clip.values);
}

TEST(WithChannels, TwoPositionsAlongOneAxisBecomeOne) {
  Motion twice = test::motion_of(kBare);
  Joint& slider = twice.skeleton.joints[1];
  slider.dofs.push_back(slider.dofs[0]);
  slider.dofs[1].coordinate = twice.skeleton.coordinates.size();
  slider.dofs[1].rest = 0;
  twice.skeleton.coordinates.push_back({1, "again"});
  twice.clip = with_columns(twice.clip, {0, 1, 2, 3, 4, 5, 0});
  ASSERT_TRUE(validate(twice));
  const Motion whole =
      changed(twice, {.positions = shape::PositionChannels::RootAndOwn, .replaces_offsets = true});
  EXPECT_EQ(channels_of(whole, 1), channels_of(whole, 0));
  EXPECT_EQ(whole.clip.row(0)[7], 11);
  EXPECT_LT(distance(twice, whole), 1e-12);
}

TEST(WithChannels, RootPutsPositionsThatStayIntoTheOffset) {
  const Motion mixed = test::motion_of(kMixed);
  const Motion root =
      changed(mixed, {.order = std::nullopt, .positions = shape::PositionChannels::Root});
  EXPECT_EQ(channels_of(root, 0), "Xposition Yposition Zposition Zrotation Yrotation Xrotation ");
  EXPECT_EQ(channels_of(root, 1), "Zrotation Xrotation Yrotation ");
  EXPECT_EQ(root.skeleton.joints[1].offset, Vec3(4, 5, 6));
  EXPECT_EQ(distance(mixed, root), 0);
}

TEST(WithChannels, RootRefusesToLosePositionsThatMove) {
  std::string moving = kMixed;
  moving.replace(moving.find("7 20 30 40 6"), 12, "7 20 30 40 8");
  const Motion mixed = test::motion_of(moving);
  Diagnostics diagnostics;
  shape::ChannelOptions options;
  options.positions = shape::PositionChannels::Root;
  const auto refused = shape::with_channels(mixed, options, diagnostics);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::DataLoss);
  EXPECT_EQ(refused.error().code, "EDT001");
  EXPECT_EQ(
      refused.error().message,
      "joint 'a' moves along Zposition by up to 2, which is lost without its position channels");
  options.lenient = true;
  EXPECT_TRUE(shape::with_channels(mixed, options, diagnostics));
  EXPECT_EQ(test::codes_of(diagnostics), std::vector<std::string>{"EDT001"});
}

/// A leg of three joints with six channels each, whose positions are OFFSET but for some noise.
Motion leg_with_noise(double thigh, double shin, double foot) {
  const std::string channels =
      "CHANNELS 6 Xposition Yposition Zposition Xrotation Yrotation Zrotation\n";
  const auto row = [&](double side, double angle) {
    return fmt::format("0 97 {} 0 0 0 {} -6 0 5 0 0 0 {} 0 {} 0 0 0 -46 {} 0 0 7\n", angle,
                       9 + side * thigh, -44 - side * shin, angle, side * foot);
  };
  return test::motion_of(
      "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\n" + channels + "JOINT Thigh\n{\nOFFSET 9 -6 0\n" +
      channels + "JOINT Shin\n{\nOFFSET 0 -44 0\n" + channels + "JOINT Foot\n{\nOFFSET 0 -46 0\n" +
      channels + "End Site\n{\nOFFSET 0 -4 12\n}\n}\n}\n}\n}\n" +
      "MOTION\nFrames: 3\nFrame Time: 0.1\n" + row(0, 0) + row(1, 10) + row(-0.5, 30));
}

constexpr shape::ChannelOptions kRootAlone{.order = std::nullopt,
                                           .positions = shape::PositionChannels::Root};

TEST(WithChannels, RootLosesTheNoiseOfPositionsWithANote) {
  for (const double noise : {1e-6, 7e-5, 1e-3, 0.009}) {
    const Motion leg = leg_with_noise(noise, 2 * noise, noise);
    Diagnostics diagnostics;
    const auto root = shape::with_channels(leg, kRootAlone, diagnostics);
    ASSERT_TRUE(root);
    EXPECT_EQ(channels_of(*root, 2), "Xrotation Yrotation Zrotation ");
    EXPECT_EQ(root->skeleton.joints[2].offset, Vec3(0, -44, 0)) << "OFFSET keeps its bits";
    // The losses of three joints add up; the foot is where the sum is.
    const LargestDifference most = compare_motions(leg, *root).distance;
    EXPECT_EQ(most.joint, "Foot");
    EXPECT_GT(most.value, 2.2 * noise);
    EXPECT_LT(most.value, 4 * noise);
    EXPECT_EQ(test::text_of(diagnostics),
              fmt::format("note[EDT013]: the positions of 3 joints that stay but for noise are "
                          "lost: {:.2g} at the most, at 'Foot' in frame 1\n",
                          most.value));
  }
}

TEST(WithChannels, RootRefusesMoreThanAThousandthOfABone) {
  Diagnostics diagnostics;
  EXPECT_TRUE(shape::with_channels(leg_with_noise(0, 0.0439, 0), kRootAlone, diagnostics));
  const auto refused = shape::with_channels(leg_with_noise(0, 0.0441, 0), kRootAlone, diagnostics);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::DataLoss);
  EXPECT_EQ(
      refused.error().message,
      "joint 'Shin' moves along Yposition by up to 0.0441, which is lost without its position "
      "channels");
}

TEST(WithChannels, ABoneOfNoLengthIsMeasuredByTheSkeleton) {
  // The box of the leg at rest is some 100 units large.
  const auto moved = [](double noise) {
    Motion leg = leg_with_noise(0, noise, 0);
    leg.skeleton.joints[2].dofs[1].rest = 0;
    for (std::size_t f = 0; f < leg.clip.num_frames; ++f) leg.clip.mutate()[f][13] += 44;
    Diagnostics diagnostics;
    return shape::with_channels(leg, kRootAlone, diagnostics).has_value();
  };
  EXPECT_TRUE(moved(1e-4));
  EXPECT_FALSE(moved(0.01));
}

TEST(WithChannels, PositionsThatWaverElsewhereThanOffsetStayThere) {
  Motion leg = leg_with_noise(0, 1e-6, 0);
  for (std::size_t f = 0; f < leg.clip.num_frames; ++f) leg.clip.mutate()[f][13] -= 3;
  Diagnostics diagnostics;
  const auto root = shape::with_channels(leg, kRootAlone, diagnostics);
  ASSERT_TRUE(root);
  EXPECT_NEAR(root->skeleton.joints[2].offset.y(), -47, 1e-6);
  EXPECT_LT(distance(leg, *root), 1e-6);
  EXPECT_EQ(test::codes_of(diagnostics), std::vector<std::string>{"EDT013"});
}

TEST(WithChannels, PositionsThatAreAddedStayAdded) {
  ReadOptions options;
  options.of_formats = bvh::ReadOptions{bvh::PositionMode::Add};
  const auto added = test::read_bvh(kMixed, options);
  const Motion all =
      changed(added.motion(), {.order = std::nullopt, .positions = shape::PositionChannels::All});
  EXPECT_LT(distance(added.motion(), all), 1e-15);
  Document document;
  document.content = all;
  const auto again = test::read_bvh(test::write_to_string(document), options);
  EXPECT_LT(distance(added.motion(), again.motion()), 1e-15);
}

TEST(WithChannels, ARobotCannotHaveThem) {
  Motion robot;
  Joint base;
  base.name = "base";
  base.dofs = {{DofKind::Free, Vec3::UnitX(), 0, 0}};
  robot.skeleton.joints = {base};
  robot.skeleton.coordinates.resize(7);
  robot.clip.num_coordinates = 7;
  Diagnostics diagnostics;
  const auto refused =
      shape::with_channels(robot, {.order = shape::parse_rotation_order("XYZ")}, diagnostics);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "EDT002");
}

TEST(ParseRotationOrder, TakesTwelveOrders) {
  EXPECT_EQ(shape::parse_rotation_order("zxy"), (shape::RotationOrder{2, 0, 1}));
  EXPECT_EQ(shape::parse_rotation_order("ZXZ"), (shape::RotationOrder{2, 0, 2}));
  for (const char* word : {"", "XY", "XXY", "XYY", "XYW", "XYZX"}) {
    EXPECT_FALSE(shape::parse_rotation_order(word)) << word;
  }
}

TEST(Channels, EveryNumberOfThreadsGivesTheSameBits) {
  const Motion walk = examples::make_walk({.num_frames = 1000});
  shape::ChannelOptions options;
  options.order = shape::RotationOrder{0, 1, 2};
  const auto with_threads = [&](std::size_t threads) {
    const test::Threads some(threads);
    return changed(walk, options);
  };
  const Motion alone = with_threads(1);
  for (const std::size_t threads : test::kThreadCounts) {
    EXPECT_EQ(with_threads(threads).clip.values, alone.clip.values);
  }
}

}  // namespace
}  // namespace kinefile
