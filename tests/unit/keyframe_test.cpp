// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "support/keyframes.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

using Ticks = std::vector<std::size_t>;

Result<servo::Keyframes> with_tolerance(const servo::JointTrajectory& trajectory,
                                        const ServoMap& map, double tolerance,
                                        FlowFormat format = FlowFormat::V1R4) {
  Diagnostics diagnostics;
  return servo::keyframe(trajectory, map,
                         {.num_poses = {}, .tolerance = tolerance, .format = format}, diagnostics);
}

Result<servo::Keyframes> with_poses(const servo::JointTrajectory& trajectory, const ServoMap& map,
                                    std::size_t num_poses) {
  Diagnostics diagnostics;
  return servo::keyframe(trajectory, map, {.num_poses = num_poses, .tolerance = {}}, diagnostics);
}

const PoseBlock& made_pose(const PoseFlow& flow, std::size_t block) {
  return std::get<PoseBlock>(flow.blocks.at(block).body);
}

double largest_error(const servo::Keyframes& keyframes) {
  double largest = 0;
  for (const servo::KeyframeError& error : keyframes.errors)
    largest = std::max(largest, error.largest);
  return largest;
}

/// All sets of ticks that begin with 0 and end with the last one.
std::vector<Ticks> all_paths(std::size_t last_tick) {
  std::vector<Ticks> paths;
  for (std::size_t bits = 0; bits < (std::size_t{1} << (last_tick - 1)); ++bits) {
    Ticks ticks = {0};
    for (std::size_t tick = 1; tick < last_tick; ++tick) {
      if ((bits >> (tick - 1) & 1) != 0) ticks.push_back(tick);
    }
    ticks.push_back(last_tick);
    paths.push_back(std::move(ticks));
  }
  return paths;
}

// Up 3 degrees in 3 ticks, 300 words; down again in 6.
const std::vector<double> kTent = {0, 1, 2, 3, 2.5, 2, 1.5, 1, 0.5, 0};

TEST(Keyframe, LinesBecomeAPoseAtTheirEnds) {
  const auto made = with_tolerance(trajectory_of_degrees(kTent), map_of_joints(1), 0);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->ticks, (Ticks{0, 3, 9}));
  ASSERT_EQ(made->flow.blocks.size(), 5u);
  EXPECT_EQ(made->flow.num_sliders, 62u);
  EXPECT_EQ(made_pose(made->flow, 1).ticks, 60);  // the lead-in
  EXPECT_EQ(made_pose(made->flow, 2).ticks, 3);
  EXPECT_EQ(made_pose(made->flow, 3).ticks, 6);
  EXPECT_EQ(made_pose(made->flow, 2).words[0], (SliderWord{300, true}));
  EXPECT_EQ(made_pose(made->flow, 2).words[1], (SliderWord{0, false}));
  EXPECT_EQ(largest_error(*made), 0);
}

TEST(Keyframe, TheFlowIsLaidOutAsTheEditorDoes) {
  const auto made = with_tolerance(trajectory_of_degrees(kTent), map_of_joints(1), 0);
  ASSERT_TRUE(made);
  const std::vector<Block>& blocks = made->flow.blocks;
  EXPECT_TRUE(std::holds_alternative<StartBlock>(blocks.front().body));
  EXPECT_TRUE(std::holds_alternative<EndBlock>(blocks.back().body));
  EXPECT_EQ(blocks[0].y, 10);
  EXPECT_EQ(blocks[1].y, 46);
  EXPECT_EQ(blocks[3].y, 46 + 2 * 54);
  EXPECT_EQ(blocks[4].y, 46 + 3 * 54);
  EXPECT_EQ(blocks[1].name, "POSE 0");
  for (int b = 0; b < 4; ++b) EXPECT_EQ(blocks[static_cast<std::size_t>(b)].normal, b + 1);
  EXPECT_EQ(blocks.back().normal, kNoBlock);
  EXPECT_TRUE(find_flow_faults(made->flow).empty());
}

TEST(Keyframe, AsWordNThePosesFollowEachOther) {
  const auto made =
      with_tolerance(trajectory_of_degrees(kTent), map_of_joints(1), 0, FlowFormat::WordN);
  ASSERT_TRUE(made);
  ASSERT_EQ(made->flow.blocks.size(), 3u);
  EXPECT_EQ(made->flow.blocks[0].normal, 1);
  EXPECT_EQ(made->flow.blocks[2].normal, kNoBlock);
  EXPECT_EQ(made_pose(made->flow, 1).words[0], (SliderWord{300, true}));
}

TEST(Keyframe, StretchesAreSplitAt239Ticks) {
  const auto made =
      with_tolerance(trajectory_of_degrees(std::vector<double>(600, 7)), map_of_joints(1), 1);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->ticks.size(), 4u);  // 599 ticks take three poses, and the one that leads in
  EXPECT_EQ(made->ticks.back(), 599u);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_LE(made->ticks[i] - made->ticks[i - 1], 239u);
}

TEST(Keyframe, OneFrameIsOnePose) {
  const auto made = with_tolerance(trajectory_of_degrees({12.5}), map_of_joints(1), 0);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->ticks, Ticks{0});
  EXPECT_EQ(made_pose(made->flow, 1).words[0].value, 1250);
}

TEST(Keyframe, TheLastFrameIsShownAtTheTickAfterIt) {
  servo::JointTrajectory trajectory = trajectory_of_degrees({0, 10, 20});
  trajectory.frame_time = 0.04;  // 4.8 ticks in all
  const auto made = with_tolerance(trajectory, map_of_joints(1), 1);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->ticks.back(), 5u);
  EXPECT_EQ(made_pose(made->flow, made->flow.blocks.size() - 2).words[0].value, 2000);
}

TEST(Keyframe, BetweenFramesTheTrajectoryIsALine) {
  servo::JointTrajectory trajectory = trajectory_of_degrees({0, 12});
  trajectory.frame_time = 0.1;
  const auto made = with_tolerance(trajectory, map_of_joints(1), 0);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->ticks, (Ticks{0, 6}));  // 200 words a tick
}

TEST(Keyframe, SignAndOffsetSayWhatAWordMeans) {
  ServoMap map = map_of_joints(1);
  map.entries[0].sign = -1;
  map.entries[0].offset = 50;
  const auto made = with_tolerance(trajectory_of_degrees({1, 2}), map, 0);
  ASSERT_TRUE(made);
  EXPECT_EQ(made_pose(made->flow, 1).words[0].value, -50);
  EXPECT_EQ(made_pose(made->flow, 2).words[0].value, -150);
}

TEST(Keyframe, WordsAreRoundedToStepsWithinLimits) {
  ServoMap map = map_of_joints(1, 128);
  map.entries[0].minimum = -200;
  map.entries[0].maximum = 400;  // -200, -72, 56, 184, 312
  const auto made = with_poses(trajectory_of_degrees({1.3, -1.1, 99}), map, 3);
  ASSERT_TRUE(made);
  const auto word = [&](std::size_t block) { return made_pose(made->flow, block).words[0].value; };
  EXPECT_EQ(word(1), 184);
  EXPECT_EQ(word(2), -72);
  EXPECT_EQ(word(3), 312);
}

TEST(Keyframe, AnglesBeyondTheLimitsAreTold) {
  ServoMap map = map_of_joints(1);
  map.entries[0].maximum = 200;
  Diagnostics diagnostics;
  const auto made = servo::keyframe(trajectory_of_degrees(kTent), map,
                                    {.num_poses = 4, .tolerance = {}}, diagnostics);
  ASSERT_TRUE(made);
  EXPECT_EQ(text_of(diagnostics),
            "warning[KEY003]: joint 'j0' goes beyond the limits of slider 0: up to 1 degrees are "
            "cut off (at 0.050 s)\n");
  EXPECT_EQ(made->errors[0].largest, 1);
  EXPECT_EQ(made->errors[0].largest_seconds, 3.0 / 60);
}

TEST(Keyframe, WhatLimitsCutOffDoesNotSpoilTheRest) {
  ServoMap map = map_of_joints(2);
  map.entries[1].maximum = 0;
  servo::JointTrajectory trajectory = trajectory_of_degrees({});
  trajectory.joints = {"j0", "j1"};
  for (const double degrees : kTent) {
    trajectory.angles.append({degrees * kRadiansPerDegree, 90 * kRadiansPerDegree});
  }
  trajectory.num_frames = kTent.size();
  const auto made = with_poses(trajectory, map, 5);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->ticks, (Ticks{0, 3, 9}));
  EXPECT_EQ(made->errors[0].largest, 0);
  EXPECT_EQ(made->errors[1].largest, 90);
}

TEST(Keyframe, AToleranceThatNoWordsKeepIsRefused) {
  ServoMap map = map_of_joints(1);
  map.entries[0].maximum = 200;
  const auto limited = with_tolerance(trajectory_of_degrees(kTent), map, 0.25);
  ASSERT_FALSE(limited);
  EXPECT_EQ(limited.error().code, "KEY002");
  EXPECT_EQ(limited.error().message,
            "expected words within 0.25 degrees of the trajectory, found that those of joint 'j0', "
            "rounded and limited as the servo map says, come no nearer than 1 degrees (at 0.050 "
            "s)");
  // Steps of 1.28 degrees: 0.5 is nearer to 0.48 than to -0.8, but not near.
  const auto coarse = with_tolerance(trajectory_of_degrees({0.5}), map_of_joints(1, 128), 0.01);
  ASSERT_FALSE(coarse);
  EXPECT_EQ(coarse.error().code, "KEY002");
}

TEST(Keyframe, InnerWordsNeedNotBeOnSteps) {
  // On steps of 128, 0.64 degrees can only be passed, from 0 to 1.28: words 0, 64, 128.
  const auto made =
      with_tolerance(trajectory_of_degrees({0, 0.64, 1.28}), map_of_joints(1, 128), 0);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->ticks, (Ticks{0, 2}));
}

TEST(Keyframe, ToleranceOrNumberOfPosesAndNotBoth) {
  Diagnostics diagnostics;
  const servo::JointTrajectory trajectory = trajectory_of_degrees(kTent);
  const ServoMap map = map_of_joints(1);
  const auto code = [&](const servo::KeyframeOptions& options) {
    const auto made = servo::keyframe(trajectory, map, options, diagnostics);
    return made ? std::string() : made.error().code + " " + made.error().message;
  };
  EXPECT_EQ(code({}), "KEY001 expected either a number of poses or a tolerance");
  EXPECT_EQ(code({.num_poses = 3, .tolerance = 1}),
            "KEY001 expected either a number of poses or a tolerance");
  EXPECT_EQ(code({.num_poses = {}, .tolerance = -1}),
            "KEY001 expected a tolerance from 0 degrees up, found -1");
  EXPECT_EQ(code({.num_poses = {}, .tolerance = std::nan("")}),
            "KEY001 expected a tolerance from 0 degrees up, found nan");
  EXPECT_EQ(code({.num_poses = 3, .tolerance = {}, .lead_in_ticks = 240}),
            "KEY001 expected a lead-in of 1 to 239 ticks, found 240");
  EXPECT_EQ(code({.num_poses = 1, .tolerance = {}}),
            "KEY001 expected at least 2 poses, since none takes longer than 239 ticks, found 1");
  ServoMap wide = map;
  wide.num_sliders = 64;
  EXPECT_EQ(servo::keyframe(trajectory, wide, {.num_poses = 3, .tolerance = {}}, diagnostics)
                .error()
                .code,
            "KEY001");
}

TEST(Keyframe, WhatIsNoTrajectoryIsRefused) {
  const ServoMap map = map_of_joints(1);
  const auto code = [&](const servo::JointTrajectory& trajectory) {
    const auto made = with_tolerance(trajectory, map, 1);
    return made ? std::string() : made.error().code;
  };
  servo::JointTrajectory none;
  EXPECT_EQ(code(none), "SVM010");
  EXPECT_EQ(code(trajectory_of_degrees({})), "KEY001");
  EXPECT_EQ(code(trajectory_of_degrees({0, std::nan("")})), "KEY004");
  EXPECT_EQ(code(trajectory_of_degrees({0, INFINITY})), "KEY004");
  servo::JointTrajectory odd = trajectory_of_degrees({0, 1});
  odd.frame_time = std::nan("");
  EXPECT_EQ(code(odd), "KEY004");
  odd.frame_time = -1;
  EXPECT_EQ(code(odd), "KEY004");
  odd.frame_time = 1e300;
  EXPECT_EQ(code(odd), "KEY001");
  servo::JointTrajectory unknown = trajectory_of_degrees({0, 1});
  unknown.joints[0] = "tail";
  EXPECT_EQ(code(unknown), "SVM010");
}

TEST(Keyframe, TheFlowRunsThroughTheTrajectory) {
  Diagnostics diagnostics;
  const ServoMap map = map_of_joints(1);
  const auto made =
      servo::keyframe(trajectory_of_degrees(kTent), map,
                      {.num_poses = {}, .tolerance = 0, .lead_in_ticks = 5}, diagnostics);
  ASSERT_TRUE(made);
  const auto run = flow::run(made->flow, {}, diagnostics);
  ASSERT_TRUE(run);
  EXPECT_EQ(run->num_ticks, 5u + 9u);
  for (std::size_t tick = 0; tick < kTent.size(); ++tick) {
    EXPECT_EQ(run->sliders[(5 + tick) * run->num_sliders], 100 * kTent[tick]);
  }
}

TEST(Keyframe, FewestPosesAsAllSubsetsSay) {
  for (std::uint32_t seed = 1; seed <= 24; ++seed) {
    const ServoMap map = map_of_joints(1 + seed % 3, seed % 2 == 0 ? 1 : 128);
    const servo::JointTrajectory trajectory = swinging(map.entries.size(), 12, seed);
    for (const double tolerance : {0.05, 0.3, 0.7, 1.5, 4.0}) {
      std::size_t fewest = 1000;
      double least = INFINITY;
      for (const Ticks& ticks : all_paths(11)) {
        const double error = error_of_ticks(trajectory, map, ticks);
        if (error > tolerance || ticks.size() > fewest) continue;
        least = ticks.size() < fewest ? error : std::min(least, error);
        fewest = ticks.size();
      }
      const auto made = with_tolerance(trajectory, map, tolerance);
      ASSERT_EQ(made.has_value(), fewest < 1000) << seed << " " << tolerance;
      if (!made) continue;
      EXPECT_EQ(made->ticks.size(), fewest) << seed << " " << tolerance;
      EXPECT_NEAR(largest_error(*made), least, 1e-12) << seed << " " << tolerance;
    }
  }
}

TEST(Keyframe, LeastErrorAsAllSubsetsSay) {
  for (std::uint32_t seed = 1; seed <= 24; ++seed) {
    const ServoMap map = map_of_joints(1 + seed % 3, seed % 2 == 0 ? 1 : 128);
    const servo::JointTrajectory trajectory = swinging(map.entries.size(), 12, seed);
    std::vector<double> least(13, INFINITY);
    for (const Ticks& ticks : all_paths(11)) {
      double& own = least[ticks.size()];
      own = std::min(own, error_of_ticks(trajectory, map, ticks));
    }
    double bound = INFINITY;
    for (std::size_t num_poses = 2; num_poses <= 12; ++num_poses) {
      bound = std::min(bound, least[num_poses]);
      const auto made = with_poses(trajectory, map, num_poses);
      ASSERT_TRUE(made);
      EXPECT_LE(made->ticks.size(), num_poses);
      EXPECT_NEAR(largest_error(*made), bound, 1e-12) << seed << " " << num_poses;
    }
  }
}

TEST(Keyframe, NeverWorseThanGreedyReduction) {
  for (std::uint32_t seed = 1; seed <= 2; ++seed) {
    const ServoMap map = map_of_joints(3, seed % 2 == 0 ? 1 : 128);
    const servo::JointTrajectory trajectory = swinging(3, 250, seed);
    for (const std::size_t num_poses : {6u, 20u}) {
      const auto made = with_poses(trajectory, map, num_poses);
      ASSERT_TRUE(made);
      const double own = error_of_ticks(trajectory, map, made->ticks);
      EXPECT_LE(own, greedy_error(trajectory, map, num_poses)) << seed << " " << num_poses;
      EXPECT_LE(own, farthest_first_error(trajectory, map, num_poses)) << seed << " " << num_poses;
    }
    for (const double tolerance : {2.0}) {
      const auto made = with_tolerance(trajectory, map, tolerance);
      ASSERT_TRUE(made);
      EXPECT_LE(made->ticks.size(), greedy_ticks(trajectory, map, tolerance).size());
      EXPECT_LE(largest_error(*made), tolerance);
    }
  }
}

TEST(Keyframe, ErrorsAreThoseOfTheDefinition) {
  const ServoMap map = map_of_joints(3, 128);
  const servo::JointTrajectory trajectory = swinging(3, 200, 7);
  const auto made = with_poses(trajectory, map, 8);
  ASSERT_TRUE(made);
  EXPECT_NEAR(largest_error(*made), error_of_ticks(trajectory, map, made->ticks), 1e-12);
  for (const servo::KeyframeError& error : made->errors) {
    EXPECT_GT(error.rms, 0);
    EXPECT_LE(error.rms, error.largest);
  }
}

}  // namespace
}  // namespace kinefile::test
