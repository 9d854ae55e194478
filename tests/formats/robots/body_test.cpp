// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "formats/robots/robots.hpp"

namespace kinefile::test {
namespace {

/// A .body file with these lines behind its head.
std::string body_with(const std::string& lines, const std::string& head = {}) {
  return "format: ChoreonoidBody\nformat_version: 2.0\nname: t\n" + head + "links:\n" + lines;
}

/// A root A and a link B with these keys on it, each in a line with its indentation.
std::string body_with_b(const std::string& keys, const std::string& head = {}) {
  return body_with("  - name: A\n    joint_type: free\n  - name: B\n    parent: A\n" + keys, head);
}

Joint joint_b(const std::string& keys, const std::string& head = {}) {
  const Document document = robot_of("body", body_with_b(keys, head));
  return skeleton_of(document).joints.at(1);
}

TEST(Body, LinksAreInDepthFirstOrderWithChildrenAsDeclared) {
  const Document document = robot_of(
      "body", body_with("  - { name: D, parent: B }\n  - { name: C, parent: A }\n"
                        "  - { name: A }\n  - { name: B, parent: A }\n  - { name: E, parent: C }\n",
                        "rootLink: A\n"));
  EXPECT_EQ(names_of(skeleton_of(document)), "A C E B D");
}

TEST(Body, TheRootMovesFreelyAndRestsWhereItSays) {
  const Document document = robot_of(
      "body", body_with("  - name: A\n    joint_type: fixed\n    translation: [ 1, 2, 3 ]\n"
                        "    rotation: [ 0, 0, 2, 90 ]\n"));
  const Joint& root = skeleton_of(document).joints.at(0);
  ASSERT_EQ(root.dofs.size(), 1u);
  EXPECT_EQ(root.dofs[0].kind, DofKind::Free);
  EXPECT_EQ(root.offset, Vec3::Zero());
  EXPECT_EQ(root.rest_rotation.coeffs(), Quat::Identity().coeffs());
  const std::array<double, 7> expected = {1, 2, 3, std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(root.free_rest[i], expected[i], 1e-15) << i;
}

TEST(Body, ColumnsFollowTheIdsThenTheVirtualJoints) {
  const Document document =
      robot_of("body", body_with("  - { name: A, joint_type: free }\n"
                                 "  - { name: V, parent: A, joint_type: revolute }\n"
                                 "  - { name: B, parent: A, joint_type: revolute, joint_id: 3 }\n"
                                 "  - { name: C, parent: B, joint_type: prismatic, joint_id: 0 }\n"
                                 "  - { name: F, parent: B, joint_type: fixed }\n"
                                 "  - { name: G, parent: B, joint_type: free, joint_id: -1 }\n"
                                 "  - { name: H, parent: B, joint_type: fixed, joint_id: 2 }\n"));
  const Skeleton& skeleton = skeleton_of(document);
  EXPECT_EQ(joint_columns_of(skeleton), "C.q A.q1 H.q B.q V.q G.q");
  EXPECT_EQ(num_joint_ids(document), 4u);
  EXPECT_EQ(skeleton.joints[joint_of_name(skeleton, "B")].dofs.at(0).coordinate, 10u);
  EXPECT_EQ(skeleton.joints[joint_of_name(skeleton, "V")].dofs.at(0).coordinate, 11u);
  EXPECT_TRUE(skeleton.joints[joint_of_name(skeleton, "G")].dofs.empty());
  EXPECT_TRUE(skeleton.joints[joint_of_name(skeleton, "H")].dofs.empty());
}

TEST(Body, AListOfTranslationsIsSummedAndOneOfRotationsMultipliedFromTheLeft) {
  const Joint joint = joint_b(
      "    translation: [ [ 1, 2, 3 ], [ 10, 20, 30 ] ]\n"
      "    rotation: [ [ 0, 0, 1, 90 ], [ 1, 0, 0, 90 ] ]\n");
  EXPECT_EQ(joint.offset, Vec3(11, 22, 33));
  // Rz(90) Rx(90) takes z to x: Rx(90) to -y, Rz(90) that to x.
  EXPECT_LE((joint.rest_rotation * Vec3::UnitZ() - Vec3::UnitX()).norm(), 1e-15);
}

TEST(Body, ListsInBlocksAreReadTheSame) {
  const Joint joint = joint_b(
      "    translation:\n      - 1\n      - 2\n      - 3\n"
      "    rotation:\n      - [ 0, 0, 1, 90 ]\n      - [ 1, 0, 0,\n          90 ]\n");
  EXPECT_EQ(joint.offset, Vec3(1, 2, 3));
  EXPECT_LE((joint.rest_rotation * Vec3::UnitZ() - Vec3::UnitX()).norm(), 1e-15);
}

TEST(Body, ListsOfAnyDepthAreReadInTheirOrder) {
  for (const char* keys :
       {"    translation: [ [ [ 1, 2, 3 ], [ 10, 20, 30 ] ], [ 100, 200, 300 ] ]\n"
        "    rotation: [ [ [ 0, 0, 1, 90 ] ], [ 1, 0, 0, 90 ] ]\n",
        "    translation:\n      - [ [ [ 1, 2, 3 ] ], [ 10, 20, 30 ] ]\n"
        "      -\n        - [ 100, 200, 300 ]\n        - [ [ [ [ 0, 0, 0 ] ] ] ]\n"
        "    rotation:\n      - - [ 0, 0, 1, 90 ]\n        - [ 1, 0, 0, 90 ]\n",
        "    translation: [ [ 1, 2, 3 ], [ [ 10, 20, 30 ], [ 100, 200, &z 300 ] ] ]\n"
        "    rotation: [ [ [ [ 0, 0, 1, 90 ], [ 1, 0, 0, 90 ] ] ] ]\n"}) {
    const Joint joint = joint_b(keys);
    EXPECT_EQ(joint.offset, Vec3(111, 222, 333)) << keys;
    EXPECT_LE((joint.rest_rotation * Vec3::UnitZ() - Vec3::UnitX()).norm(), 1e-15) << keys;
  }
  for (const char* list : {"[ [ [ 1, 2 ] ], [ 1, 2, 3 ] ]", "[ 1, [ 1, 2, 3 ] ]",
                           "[ [ 1, 2, 3 ], 1 ]", "[ [ [ 1, 2, 3 ], [] ] ]", "[ [ [ 1, 2, x ] ] ]",
                           "[ [ { a: 1 } ] ]", "[ [ 1, [ 1, 2, 3 ] ] ]", "[]"}) {
    const ReadText read =
        read_robot("body", body_with_b(std::string("    translation: ") + list + "\n"));
    EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"BDY004"}) << list;
  }
}

TEST(Body, AnglesAreInDegreesUnlessTheFileSaysRadians) {
  const std::string keys =
      "    joint_type: revolute\n    joint_range: [ -2, 3 ]\n    joint_angle: 1\n"
      "    max_joint_velocity: 4\n    rotation: [ 0, 0, 1, 2 ]\n";
  const Joint degrees = joint_b(keys, "angle_unit: degree\n");
  EXPECT_EQ(degrees.dofs[0].lower, -2 * kRadiansPerDegree);
  EXPECT_EQ(degrees.dofs[0].upper, 3 * kRadiansPerDegree);
  EXPECT_EQ(degrees.dofs[0].rest, kRadiansPerDegree);
  EXPECT_EQ(degrees.dofs[0].max_speed, 4 * kRadiansPerDegree);
  EXPECT_EQ(degrees.rest_rotation.z(), std::sin(kRadiansPerDegree));
  const Joint radians = joint_b(keys, "angleUnit: radian\n");
  EXPECT_EQ(radians.dofs[0].lower, -2);
  EXPECT_EQ(radians.dofs[0].upper, 3);
  EXPECT_EQ(radians.dofs[0].rest, 1);
  EXPECT_EQ(radians.dofs[0].max_speed, 4);
  EXPECT_EQ(radians.rest_rotation.z(), std::sin(1.0));
}

TEST(Body, LengthsOfPrismaticJointsAreNoAngles) {
  const Joint joint = joint_b(
      "    jointType: slide\n    jointRange: 4\n    jointDisplacement: 0.5\n"
      "    jointVelocityRange: [ -2, 1 ]\n    jointAxis: -y\n");
  EXPECT_EQ(joint.dofs.at(0).kind, DofKind::Translation);
  EXPECT_EQ(joint.dofs[0].lower, -4);
  EXPECT_EQ(joint.dofs[0].upper, 4);
  EXPECT_EQ(joint.dofs[0].rest, 0.5);
  EXPECT_EQ(joint.dofs[0].max_speed, 2);
  EXPECT_EQ(joint.dofs[0].axis, Vec3(0, -1, 0));
}

TEST(Body, InfiniteLimitsAreNone) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto limits_of = [](const std::string& keys) {
    const Joint joint = joint_b("    joint_type: revolute\n" + keys);
    const DegreeOfFreedom& dof = joint.dofs.at(0);
    return std::vector<double>{dof.lower, dof.upper, dof.max_speed};
  };
  for (const char* word : {"inf", "-inf", "Infinity", "1e999", ".inf", "-.Inf", "unlimited"}) {
    const std::string limit = word;
    EXPECT_EQ(limits_of("    joint_range: [ 0, " + limit + " ]\n"),
              (std::vector<double>{0, kInfinity, kInfinity}))
        << word;
    EXPECT_EQ(limits_of("    joint_range: [ " + limit + ", 0 ]\n"),
              (std::vector<double>{-kInfinity, 0, kInfinity}))
        << word;
    EXPECT_EQ(limits_of("    joint_range: " + limit + "\n    max_joint_velocity: " + limit + "\n"),
              (std::vector<double>{-kInfinity, kInfinity, kInfinity}))
        << word;
    EXPECT_EQ(limits_of("    joint_velocity_range: [ -1, " + limit + " ]\n")[2], kInfinity) << word;
  }
  for (const char* word : {"nan", ".nan", "", "[]"}) {
    const ReadText read = read_robot(
        "body", body_with(std::string("  - name: A\n  - name: B\n    parent: A\n    joint_type: "
                                      "revolute\n    joint_range: [ 0, ") +
                          word + " ]\n"));
    EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"BDY004"}) << word;
  }
}

TEST(Body, ANodeOfASubBodyTakesLimitsAway) {
  ReadOptions options;
  options.companions =
      files_of({{"p.body", body_with("  - { name: P, joint_type: revolute, joint_range: 5 }\n")}});
  const Document document = robot_of(
      "body",
      body_with("  - name: A\n  - { type: SubBody, uri: p.body, parent: A, joint_range: inf }\n"),
      options);
  const DegreeOfFreedom& dof = skeleton_of(document).joints.at(1).dofs.at(0);
  EXPECT_TRUE(std::isinf(dof.lower) && dof.lower < 0);
  EXPECT_TRUE(std::isinf(dof.upper) && dof.upper > 0);
}

TEST(Body, AJointTurnsBehindItsOwnRotation) {
  const Document document = robot_of(
      "body",
      body_with("  - name: A\n  - name: B\n    parent: A\n    joint_type: revolute\n"
                "    joint_axis: [ 0, 0, 1 ]\n    joint_id: 0\n    translation: [ 1, 0, 0 ]\n"
                "    rotation: [ 1, 0, 0, 90 ]\n"
                "  - name: C\n    parent: B\n    translation: [ 1, 0, 0 ]\n"));
  const WorldPoses poses = poses_of(skeleton_of(document), {0, 0, 0, 1, 0, 0, 0, kPi / 2});
  // Rz(90) takes C's x to y, Rx(90) that to z.
  EXPECT_LE((position_in(poses, 2) - Vec3(1, 0, 1)).norm(), 1e-15);
}

TEST(Body, ATrackBecomesAChainOfVirtualJoints) {
  const Document document = robot_of(
      "body", body_with("  - name: A\n  - type: ContinuousTrack\n    name: T\n    parent: A\n"
                        "    numJoints: 3\n    joint_axis: Y\n    jointOffset: [ 0.5, 0, 0 ]\n"
                        "    translation: [ 1, 0, 0 ]\n    initialJointAngles: [ 30 ]\n"));
  const Skeleton& skeleton = skeleton_of(document);
  EXPECT_EQ(names_of(skeleton), "A T0 T1 T2");
  EXPECT_EQ(joint_columns_of(skeleton), "T0.q T1.q T2.q");
  EXPECT_TRUE(skeleton.joints[1].dofs.empty());
  EXPECT_EQ(skeleton.joints[1].offset, Vec3(1, 0, 0));
  EXPECT_EQ(skeleton.joints[2].offset, Vec3(0.5, 0, 0));
  EXPECT_EQ(skeleton.joints[2].dofs.at(0).axis, Vec3::UnitY());
  EXPECT_EQ(skeleton.joints[2].dofs[0].rest, 30 * kRadiansPerDegree);
  EXPECT_EQ(skeleton.joints[3].dofs.at(0).rest, 0);
}

TEST(Body, NodesMayStandBehindTheirType) {
  const Document document =
      robot_of("body", body_with("  Link: { name: A }\n  Skip: { name: B, parent: A }\n"));
  EXPECT_EQ(names_of(skeleton_of(document)), "A");
}

constexpr char kHand[] =
    "format: ChoreonoidBody\nformat_version: 1.0\nangle_unit: radian\nname: hand\nlinks:\n"
    "  - { name: PALM, translation: [ 9, 9, 9 ] }\n"
    "  - { name: FINGER, parent: PALM, joint_type: revolute, joint_id: 0, joint_name: bend,\n"
    "      joint_range: [ 0, 1 ] }\n";

TEST(Body, ASubBodyComesWithOtherNamesIdsAndPlace) {
  const std::string text = body_with(
      "  - name: A\n"
      "  - type: SubBody\n    uri: parts/../parts/./hand.body\n    parent: A\n    prefix: L_\n"
      "    suffix: _1\n    joint_id_offset: 5\n    translation: [ 1, 0, 0 ]\n"
      "    rotation: [ 0, 0, 1, 90 ]\n"
      "  - type: SubBody\n    uri: parts/hand.body\n    parent: L_FINGER_1\n    prefix: R_\n");
  const Document document =
      robot_of("body", text, {.companions = files_of({{"parts/hand.body", kHand}})});
  const Skeleton& skeleton = skeleton_of(document);
  EXPECT_EQ(names_of(skeleton), "A L_PALM_1 L_FINGER_1 R_PALM R_FINGER");
  EXPECT_EQ(skeleton.joints[2].dofs.at(0).coordinate, kRootColumns + 5);
  EXPECT_EQ(skeleton.joints[2].joint_name, "L_bend_1");
  EXPECT_EQ(skeleton.joints[1].offset, Vec3(1, 0, 0));
  EXPECT_NEAR(skeleton.joints[1].rest_rotation.z(), std::sqrt(0.5), 1e-15);
  EXPECT_EQ(skeleton.joints[2].dofs.at(0).upper, 1);  // each file has its own unit of angles
  EXPECT_EQ(skeleton.joints[3].offset, Vec3(9, 9, 9));
  EXPECT_EQ(skeleton.joints[3].parent, 2u);
}

TEST(Body, ASubBodyMayLieBelowAnotherOnesFolder) {
  const std::string outer = body_with(
      "  - { name: A }\n  - { type: SubBody, uri: sub/arm.body, "
      "parent: A }\n");
  const std::string arm = body_with(
      "  - { name: ARM }\n  - { type: SubBody, uri: hand.body, "
      "parent: ARM }\n");
  const Document document = robot_of(
      "body", outer, {.companions = files_of({{"sub/arm.body", arm}, {"sub/hand.body", kHand}})});
  EXPECT_EQ(names_of(skeleton_of(document)), "A ARM PALM FINGER");
}

TEST(Body, PartsBesideTheFolderAreFoundWhereTheCallerAllows) {
  const std::string arm = body_with(
      "  - { name: ARM }\n  - { type: SubBody, uri: \"..\\\\hand/hand.body\", parent: ARM }\n");
  // The hand's own part is named relative to the hand's folder.
  const std::string hand = body_with(
      "  - { name: HAND }\n"
      "  - { type: SubBody, uri: ../arm/tip.body, parent: HAND }\n"
      "  - { type: SubBody, uri: file:///robots/nail.body, parent: HAND }\n");
  const Document document = robot_of(
      "body", arm,
      {.companions = files_of({{"../hand/hand.body", hand},
                               {"../arm/tip.body", body_with("  - { name: TIP }\n")},
                               {"/robots/nail.body", body_with("  - { name: NAIL }\n")}})});
  EXPECT_EQ(names_of(skeleton_of(document)), "ARM HAND TIP NAIL");
  const ReadText read = read_robot("body", arm, {.model_root = "robots"});
  const std::string told = text_of(read.diagnostics);
  EXPECT_EQ(
      told.substr(0, told.find('\n') + 1),
      "t.body:6:27: error[BDY014]: expected the file '../hand/hand.body' in the folder 'robots' "
      "or below it, found none\n");
}

TEST(Body, FilesThatNameEachOtherManyTimesStayFew) {
  // Each names the next one ten times: 10^8 links, in 9 short files.
  std::vector<std::pair<std::string, std::string>> files;
  for (int i = 0; i < 9; ++i) {
    std::string links = "  - { name: A }\n";
    for (int k = 0; k < 10 && i < 8; ++k) {
      links += "  - { type: SubBody, uri: " + std::to_string(i + 1) +
               ".body, parent: A, prefix: p" + std::to_string(k) + " }\n";
    }
    files.emplace_back(std::to_string(i) + ".body", body_with(links));
  }
  const ReadText read = read_robot("body", files.front().second,
                                   {.source_name = "0.body", .companions = files_of(files)});
  EXPECT_FALSE(read.document);
  EXPECT_NE(text_of(read.diagnostics).find("expected at most 10000 links"), std::string::npos);
}

TEST(Body, AChainOfFilesHasAnEnd) {
  std::vector<std::pair<std::string, std::string>> files;
  for (int i = 0; i < 40; ++i) {
    files.emplace_back(
        std::to_string(i) + ".body",
        body_with("  - { name: A }\n  - { type: SubBody, parent: A, prefix: x, uri: " +
                  std::to_string(i + 1) + ".body }\n"));
  }
  const ReadText read = read_robot("body", files.front().second,
                                   {.source_name = "0.body", .companions = files_of(files)});
  EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"BDY015"});
}

TEST(Body, FilesThatAreFoundUnderEveryNameAreNotReadForEver) {
  const std::string text = body_with(
      "  - { name: A }\n  - { type: SubBody, parent: A, prefix: x, uri: a/x.body }\n"
      "  - { type: SubBody, parent: A, prefix: y, uri: b/x.body }\n");
  ReadOptions options;
  options.companions.open = [&text](const std::string& name) {
    return std::optional(CompanionFile{name, text, nullptr});
  };
  const ReadText read = read_robot("body", text, options);
  EXPECT_FALSE(read.document);
  EXPECT_LT(read.diagnostics.items().size(), 5000u);
}

TEST(Body, AWrapperIsTheRobotThatItNames) {
  const Document hand = robot_of("body", "modelFile: hand.body\nstandardPose: [ 1 ]\n",
                                 {.companions = files_of({{"hand.body", kHand}})});
  EXPECT_EQ(names_of(skeleton_of(hand)), "PALM FINGER");
  const Document arm =
      robot_of("body", "modelFile: wrl/arm.wrl\n",
               {.companions = files_of({{"wrl/arm.wrl", fixture("wrl/valid/arm.wrl")}})});
  EXPECT_EQ(names_of(skeleton_of(arm)), "BASE POST SLIDE HAND");
  EXPECT_EQ(arm.format, "body");
}

TEST(Body, WrappersMayBeCalledYamlAndBeInARow) {
  const auto files = files_of({{"parts/two.yaml", "modelFile: ../hand.data\n"},
                               {"hand.data", kHand},
                               {"robot.txt", fixture("wrl/valid/arm.wrl")}});
  const Document hand = robot_of("body", "{ standardPose: [ 1 ], modelFile: parts/two.yaml }\n",
                                 {.companions = files});
  EXPECT_EQ(names_of(skeleton_of(hand)), "PALM FINGER");
  const Document arm = robot_of("body", "model_file: robot.txt\n", {.companions = files});
  EXPECT_EQ(names_of(skeleton_of(arm)), "BASE POST SLIDE HAND");
}

TEST(Body, AWrapperIsKnownByItsTopKeys) {
  for (const char* text :
       {"modelFile: a.wrl\n", "# a\nstandardPose: [ 0, 1 ]\nmodelFile: 'a.wrl'\n",
        "{ \"modelFile\": \"a.wrl\" }", "---\nmodel_file: a.body\nlist: [ 1, 2\n"}) {
    EXPECT_EQ(detect_format(text, "a.yaml")->name, "body") << text;
  }
  for (const char* text :
       {"modelFile: a.wrl\ntype: Composite\n", "components: []\nmodelFile: a.wrl\n",
        "robot: { modelFile: a.wrl }\n", "- modelFile: a.wrl\n", "note: modelFile\n",
        "modelFile: []\n", "modelFile:\n"}) {
    EXPECT_EQ(detect_format(text, "a.yaml")->name, "choreonoid") << text;
  }
}

TEST(Body, FaultsOfAnotherFileAreInThatFile) {
  const std::string text =
      body_with("  - { name: A }\n  - { type: SubBody, uri: b.body, parent: A }\n");
  const ReadText read = read_robot(
      "body", text, {.companions = files_of({{"b.body", body_with("  - { name: [] }\n")}})});
  ASSERT_EQ(read.diagnostics.items().size(), 1u);
  EXPECT_EQ(read.diagnostics.items()[0].place.source, "b.body");
  EXPECT_EQ(read.diagnostics.items()[0].place.line, 5u);
}

TEST(Body, IsKnownByItsFirstLines) {
  EXPECT_EQ(detect_format("# a robot\nformat: ChoreonoidBody\n", "x")->name, "body");
  EXPECT_EQ(detect_format("{ \"format\": \"ChoreonoidBody\" }", "x")->name, "body");
  EXPECT_EQ(detect_format("about: the format ChoreonoidBody\n", "x"), nullptr);
  EXPECT_EQ(format_of_name("x/SR1.BODY")->name, "body");
}

}  // namespace
}  // namespace kinefile::test
