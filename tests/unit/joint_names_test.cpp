// SPDX-License-Identifier: MIT
#include "model/joint_names.hpp"

#include <gtest/gtest.h>

namespace kinefile {
namespace {

Skeleton named(const std::vector<std::string>& names) {
  Skeleton skeleton;
  for (const std::string& name : names) skeleton.joints.emplace_back().name = name;
  return skeleton;
}

using Indices = std::vector<std::size_t>;

TEST(JointNames, MatchWhateverTheirCaseWhereNoOtherDiffersByCaseAlone) {
  const JointNames names(named({"Hips", "Spine", "spine", "Hips"}));
  EXPECT_EQ(names.find("Hips"), (Indices{0, 3}));
  EXPECT_EQ(names.find("HIPS"), (Indices{0, 3}));
  EXPECT_EQ(names.find("spine"), Indices{2});
  EXPECT_EQ(names.find("SPINE"), Indices{});
  EXPECT_EQ(names.find("Hip"), Indices{});
}

TEST(JointNames, AStarStandsForAnyCharacters) {
  const JointNames names(named({"LeftArm", "LeftForeArm", "RightArm", "Head", "head"}));
  EXPECT_EQ(names.matching("Left*"), (Indices{0, 1}));
  EXPECT_EQ(names.matching("*arm"), (Indices{0, 1, 2}));
  EXPECT_EQ(names.matching("l*f*a*"), (Indices{0, 1}));
  EXPECT_EQ(names.matching("H*"), Indices{3});
  EXPECT_EQ(names.matching("*"), (Indices{0, 1, 2, 3, 4}));
  EXPECT_EQ(names.matching("Arm*"), Indices{});
  EXPECT_EQ(names.matching("rightarm"), Indices{2});
}

TEST(JointNames, AJointNameIsFoundWhereNoNameIs) {
  Skeleton skeleton = named({"Base", "Knee_link", "hip"});
  skeleton.joints[1].joint_name = "knee";
  skeleton.joints[2].joint_name = "Base";
  const JointNames names(skeleton);
  EXPECT_EQ(names.find("knee"), Indices{1});
  EXPECT_EQ(names.find("KNEE"), Indices{1});
  EXPECT_EQ(names.find("Base"), Indices{0});
  EXPECT_EQ(names.matching("kn*"), Indices{1});
  EXPECT_EQ(names.matching("kne*"), Indices{1});
  EXPECT_EQ(names.find(""), Indices{});
  // Two skeletons belong together by their names alone.
  EXPECT_EQ(match_joints(named({"knee"}), skeleton).size(), 0u);
}

TEST(JointNames, JointsAreMatchedOnceEachInTheirOrder) {
  const auto pairs =
      match_joints(named({"a", "B", "a", "c", "C", "a"}), named({"b", "A", "A", "c", "x"}));
  const auto expect_pair = [&pairs](std::size_t i, std::size_t first, std::size_t second) {
    ASSERT_LT(i, pairs.size());
    EXPECT_EQ(pairs[i].first, first);
    EXPECT_EQ(pairs[i].second, second);
  };
  ASSERT_EQ(pairs.size(), 4u);
  expect_pair(0, 0, 1);
  expect_pair(1, 1, 0);
  expect_pair(2, 2, 2);
  expect_pair(3, 3, 3);
}

}  // namespace
}  // namespace kinefile
