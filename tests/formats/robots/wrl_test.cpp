// SPDX-License-Identifier: MIT
#include "formats/robots/robots.hpp"

namespace kinefile::test {
namespace {

TEST(Wrl, JointsBecomeLinksWithIdsAndLimits) {
  const Document document = robot_of("wrl", fixture("wrl/valid/arm.wrl"));
  const Skeleton& skeleton = skeleton_of(document);
  EXPECT_EQ(skeleton.name, "ARM");
  EXPECT_EQ(names_of(skeleton), "BASE POST SLIDE HAND");
  EXPECT_EQ(joint_columns_of(skeleton), "POST.q BASE.q1 SLIDE.q");
  EXPECT_EQ(num_joint_ids(document), 3u);
  EXPECT_EQ(skeleton.joints[joint_of_name(skeleton, "HAND")].joint_name, "hand");
  const DegreeOfFreedom& post = skeleton.joints[1].dofs.at(0);
  EXPECT_EQ(post.lower, -2.5);
  EXPECT_EQ(post.upper, 3);
  EXPECT_EQ(post.max_speed, 5);
  EXPECT_NEAR(skeleton.joints[0].free_rest[3], std::sqrt(0.5), 1e-15);
}

TEST(Wrl, KinematicsIsAsByHand) {
  const Document document = robot_of("wrl", fixture("wrl/valid/arm.wrl"));
  const Skeleton& skeleton = skeleton_of(document);
  // The root as it rests, a quarter about z at (0, 0, 0.5); POST turns by another quarter, 0.2
  // above; SLIDE sits 1 along POST's x, which is the world's -x by then. A quarter about x takes
  // its z to POST's -y, the world's y: along it go the 0.5 of SLIDE and the 0.25 of HAND.
  std::vector<double> values = rest_coordinates(skeleton);
  values[7] = kPi / 2;
  values[9] = 0.5;
  const WorldPoses poses = poses_of(skeleton, values);
  EXPECT_LE((position_in(poses, 1) - Vec3(0, 0, 0.7)).norm(), 1e-15);
  EXPECT_LE((position_in(poses, 2) - Vec3(-1, 0.5, 0.7)).norm(), 1e-15);
  EXPECT_LE((position_in(poses, 3) - Vec3(-1, 0.75, 0.7)).norm(), 1e-15);
  EXPECT_LE((rotation_in(poses, 3) * Vec3::UnitX() - Vec3(-1, 0, 0)).norm(), 1e-15);
}

TEST(Wrl, ThePrototypeGivesTheDefaults) {
  const Document document = robot_of(
      "wrl",
      "#VRML V2.0 utf8\nPROTO Joint [\n field SFString jointType \"slide\"\n"
      " field SFVec3f jointAxis 0 1 0\n field SFInt32 jointId 0\n field MFFloat ulimit 2 ] { }\n"
      "Humanoid { humanoidBody DEF A Joint { jointId -1 children DEF B Joint { } } }\n");
  const DegreeOfFreedom& dof = skeleton_of(document).joints.at(1).dofs.at(0);
  EXPECT_EQ(dof.kind, DofKind::Translation);
  EXPECT_EQ(dof.axis, Vec3::UnitY());
  EXPECT_EQ(dof.upper, 2);
  EXPECT_EQ(dof.coordinate, 7u);
}

TEST(Wrl, InfiniteLimitsAreNone) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Document document =
      robot_of("wrl",
               "#VRML V2.0 utf8\nPROTO Joint [\n field SFString jointType \"slide\"\n"
               " field MFFloat ulimit 2 field MFFloat llimit [ -1 ] field MFFloat uvlimit 3 ] { }\n"
               "Humanoid { humanoidBody DEF A Joint { children [\n"
               "  DEF B Joint { ulimit inf llimit [ -inf, 0 ] uvlimit [ 1e999 ] }\n"
               "  DEF C Joint { ulimit [ -INF ] llimit +Infinity lvlimit -inf }\n"
               "  DEF D Joint { ulimit [ ] }\n] } }\n");
  for (std::size_t j = 1; j < 4; ++j) {
    const DegreeOfFreedom& dof = skeleton_of(document).joints.at(j).dofs.at(0);
    EXPECT_EQ(dof.upper, j < 3 ? kInfinity : 2) << j;
    EXPECT_EQ(dof.lower, j < 3 ? -kInfinity : -1) << j;
    EXPECT_EQ(dof.max_speed, j < 3 ? kInfinity : 3) << j;
  }
  const ReadText read = read_robot(
      "wrl",
      "#VRML V2.0 utf8\nHumanoid { humanoidBody DEF A Joint { jointType \"free\" ulimit nan } }\n");
  EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"WRL004"});
}

TEST(Wrl, TooManyLinksAreRefused) {
  std::string text = "#VRML V2.0 utf8\nHumanoid { humanoidBody [\n";
  for (int i = 0; i < 10'001; ++i) {
    text += "DEF J" + std::to_string(i) + " Joint { jointType \"fixed\" }\n";
  }
  const ReadText read = read_robot("wrl", text + "] }\n");
  EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"WRL013"});
}

/// A robot whose root rests at a height of 1, without a header.
constexpr char kHeaderless[] =
    "DEF box Humanoid { humanoidBody [ DEF ROOT Joint { jointType \"free\" translation 0 0 1 } ] "
    "}\n";

TEST(Wrl, AHeaderThatComesLaterOrIsMissingIsWarnedOf) {
  for (const char* before :
       {"\n\n#VRML V2.0 utf8\n", "\r\n\t #VRML V2.0 utf8 CosmoWorlds V1.0\r\n",
        "# made by hand\n#VRML V2.0 utf8\n", "", "\n", "# a comment alone\n"}) {
    const ReadText read = read_robot("wrl", std::string(before) + kHeaderless);
    EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"WRL015"}) << before;
    ASSERT_TRUE(read.document) << before;
    EXPECT_EQ(names_of(skeleton_of(*read.document)), "ROOT");
    EXPECT_EQ(skeleton_of(*read.document).joints[0].free_rest[2], 1);
  }
  for (const char* start : {"PROTO Joint [ ] { }\n", "WorldInfo { title \"box\" }\n"}) {
    const ReadText read = read_robot("wrl", std::string(start) + kHeaderless);
    EXPECT_TRUE(read.document) << start;
  }
}

TEST(Wrl, WhatIsNoVrmlIsRefused) {
  for (const char* text :
       {"", "\n\n", "hello world\n", "# a comment alone\n", "{ \"format\": 1 }\n", "<robot/>\n",
        "\"DEF\" {\n", "format: ChoreonoidBody\n", "HIERARCHY\nROOT Hips\n{\n",
        "#VRML V1.0 ascii\nSeparator { }\n", "\n#X3D V3.0 utf8\n", "1 2 3 4\n"}) {
    const ReadText read = read_robot("wrl", text);
    EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"WRL001"}) << text;
  }
}

TEST(Wrl, IsKnownByItsHeader) {
  EXPECT_EQ(detect_format("#VRML V2.0 utf8\n", "x")->name, "wrl");
  EXPECT_EQ(detect_format("\xEF\xBB\xBF\n \r\n#VRML V2.0 utf8\n", "x")->name, "wrl");
  EXPECT_EQ(detect_format("# a model\n\n#VRML V2.0 utf8\n", "x")->name, "wrl");
  EXPECT_EQ(detect_format("# a table\n0 1 2\n#VRML V2.0 utf8\n", "x"), nullptr);
  EXPECT_EQ(detect_format(kHeaderless, "x"), nullptr);
  EXPECT_EQ(detect_format(kHeaderless, "x.wrl")->name, "wrl");
  EXPECT_EQ(format_of_name("main.wrl")->name, "wrl");
}

}  // namespace
}  // namespace kinefile::test
