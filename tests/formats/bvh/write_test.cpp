// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "kinefile/bvh.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile::test {
namespace {

std::string rewritten(std::string_view text) {
  const ReadText read = read_bvh(text);
  EXPECT_TRUE(read.document) << text_of(read.diagnostics);
  return read.document ? write_to_string(*read.document) : "";
}

Error refusal_of(const Skeleton& skeleton) {
  EXPECT_TRUE(validate(skeleton));
  Document document;
  document.content = skeleton;
  Diagnostics diagnostics;
  const auto written = find_format("bvh")->write(
      document, {}, [](std::string_view) { return true; }, diagnostics);
  EXPECT_FALSE(written);
  return written ? Error{} : written.error();
}

TEST(BvhWrite, WritesTheUsualForm) {
  EXPECT_EQ(rewritten(bvh_with_rows({"1 2.50 -0 4e1 5 6 7 .5 9"})),
            "HIERARCHY\n"
            "ROOT Hips\n"
            "{\n"
            "\tOFFSET 0 0 0\n"
            "\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
            "\tJOINT A\n"
            "\t{\n"
            "\t\tOFFSET 1 2 3\n"
            "\t\tCHANNELS 3 Zrotation Xrotation Yrotation\n"
            "\t\tEnd Site\n"
            "\t\t{\n"
            "\t\t\tOFFSET 0 4 0\n"
            "\t\t}\n"
            "\t}\n"
            "}\n"
            "MOTION\n"
            "Frames: 1\n"
            "Frame Time: 0.04\n"
            "1 2.5 -0 40 5 6 7 0.5 9\n");
}

TEST(BvhWrite, WhatWeWroteIsWrittenTheSameAgain) {
  for (const std::string& name : fixtures("bvh/valid", ".bvh")) {
    const std::string once = rewritten(fixture(name));
    EXPECT_EQ(rewritten(once), once) << name;
  }
}

TEST(BvhWrite, KeepsEndSitesNamedSeveralAndNone) {
  const std::string text = fixture("bvh/valid/end_sites.bvh");
  EXPECT_EQ(rewritten(text), text);
}

TEST(BvhWrite, KeepsSeveralRootsAndTheirChannels) {
  const std::string text = fixture("bvh/valid/two_roots.bvh");
  EXPECT_EQ(rewritten(text), text);
}

TEST(BvhWrite, KeepsLineEnds) {
  std::string text;
  for (const char c : bvh_with_rows({"1 2 3 4 5 6 7 8 9"})) {
    text += c == '\n' ? "\r\n" : std::string(1, c);
  }
  const std::string written = rewritten(text);
  EXPECT_NE(written.find("HIERARCHY\r\nROOT Hips\r\n"), std::string::npos);
  EXPECT_TRUE(written.ends_with("9\r\n"));
}

TEST(BvhWrite, KeepsTheSignOfZeroInOffsets) {
  std::string text = bvh_with_rows({"1 2 3 4 5 6 7 8 9"});
  text.replace(text.find("OFFSET 0 0 0"), 12, "OFFSET -0 5 -0");
  for (const bvh::PositionMode mode : {bvh::PositionMode::Replace, bvh::PositionMode::Add}) {
    ReadOptions options;
    options.of_formats = bvh::ReadOptions{mode};
    const ReadText read = read_bvh(text, options);
    EXPECT_NE(write_to_string(*read.document).find("OFFSET -0 5 -0\n"), std::string::npos);
  }
}

TEST(BvhWrite, KeepsUnknownChannels) {
  std::string text = bvh_with_rows({"1 2 3 4 5 6 7 8 9"});
  text.replace(text.find("CHANNELS 3 Zrotation"), 20, "CHANNELS 3 Foo");
  const ReadText read = read_bvh(text, {.lenient = true});
  ASSERT_TRUE(read.document);
  EXPECT_NE(write_to_string(*read.document).find("CHANNELS 3 Foo Xrotation Yrotation\n"),
            std::string::npos);
}

TEST(BvhWrite, PrintsSoManyDecimals) {
  const ReadText read = read_bvh(bvh_with_rows({"1 2.56789 -0.0001 4 5 6 7 8 9"}));
  const std::string text = write_to_string(*read.document, "bvh", {.decimals = 2});
  EXPECT_NE(text.find("OFFSET 1.00 2.00 3.00\n"), std::string::npos);
  EXPECT_NE(text.find("\n1.00 2.57 -0.00 4.00"), std::string::npos);
  EXPECT_NE(text.find("Frame Time: 0.04\n"), std::string::npos) << "the time stays exact";
}

TEST(BvhWrite, NotesPositionsThatAreAdded) {
  std::string text = bvh_with_rows({"1 2 3 4 5 6 7 8 9"});
  text.replace(text.find("OFFSET 0 0 0"), 12, "OFFSET 0 5 0");
  ReadOptions options;
  options.of_formats = bvh::ReadOptions{bvh::PositionMode::Add};
  const ReadText read = read_bvh(text, options);
  Diagnostics diagnostics;
  ASSERT_TRUE(find_format("bvh")->write(
      *read.document, {}, [](std::string_view) { return true; }, diagnostics));
  EXPECT_EQ(codes_of(diagnostics), std::vector<std::string>{"BVH037"});
}

TEST(BvhWrite, OrdersColumnsAsTheHierarchyIsWritten) {
  // Joints need not come depth first in a skeleton, but they do in a BVH file.
  Motion motion = motion_of(fixture("bvh/valid/two_roots.bvh"));
  std::swap(motion.skeleton.joints[1], motion.skeleton.joints[2]);
  motion.skeleton.joints[3].parent = 1;
  for (Coordinate& coordinate : motion.skeleton.coordinates) {
    if (coordinate.joint == 1 || coordinate.joint == 2) coordinate.joint = 3 - coordinate.joint;
  }
  ASSERT_TRUE(validate(motion.skeleton));
  Document document;
  document.content = motion;
  EXPECT_EQ(write_to_string(document), fixture("bvh/valid/two_roots.bvh"));
}

TEST(BvhWrite, RotationsAreWrittenInTheOrderInWhichTheyAct) {
  Motion motion;
  Joint joint;
  joint.name = "base";
  joint.dofs = {{DofKind::Rotation, Vec3::UnitX(), 2, 0}, {DofKind::Rotation, Vec3::UnitY(), 0, 0}};
  motion.skeleton.joints = {joint};
  motion.skeleton.coordinates = {{0, "ry"}, {0, "unread"}, {0, "rx"}};
  motion.clip = {1, 3, {10, 20, 30}, {}};
  Document document;
  document.content = motion;
  const std::string text = write_to_string(document);
  EXPECT_NE(text.find("CHANNELS 3 Xrotation unread Yrotation\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\n30 20 10\n"), std::string::npos) << text;
}

TEST(BvhWrite, RefusesWhatItHasNoWordsFor) {
  Skeleton skeleton;
  Joint joint;
  joint.name = "base";
  skeleton.coordinates.resize(7, {0, "q"});
  joint.dofs = {{DofKind::Free, Vec3::UnitX(), 0, 0}};
  skeleton.joints = {joint};
  EXPECT_EQ(refusal_of(skeleton).kind, ErrorKind::DataLoss);
  EXPECT_EQ(refusal_of(skeleton).message,
            "BVH cannot say that joint 'base' moves freely or along its bone");
  skeleton.joints[0].dofs = {{DofKind::Ball, Vec3::UnitX(), 0, 0}};
  EXPECT_EQ(refusal_of(skeleton).message, "BVH cannot say that joint 'base' turns in any way");
  skeleton.joints[0].dofs = {{DofKind::Rotation, Vec3::UnitX(), 0, 0}};
  skeleton.joints[0].dofs[0].gain = 2;
  EXPECT_EQ(refusal_of(skeleton).message,
            "BVH cannot say that joint 'base' follows a column with a gain or a shift");
  skeleton.joints[0].dofs = {{DofKind::Rotation, Vec3(0, 0.6, 0.8), 0, 0}};
  EXPECT_EQ(refusal_of(skeleton).message,
            "BVH cannot say that joint 'base' moves about an axis other than x, y and z");
  skeleton.joints[0].dofs = {{DofKind::Rotation, Vec3::UnitX(), 0, 0},
                             {DofKind::Rotation, Vec3::UnitX(), 0, 0}};
  EXPECT_EQ(refusal_of(skeleton).message,
            "BVH cannot say that joint 'base' shares a column with another movement");
  skeleton.joints[0].dofs.clear();
  skeleton.joints[0].rest_rotation = Quat(0, 1, 0, 0);
  EXPECT_EQ(refusal_of(skeleton).message,
            "BVH cannot say that joint 'base' is turned in its rest pose");
  skeleton.joints[0].rest_rotation = Quat::Identity();
  skeleton.coordinates[3].channel = "Zrotation";
  EXPECT_EQ(refusal_of(skeleton).message,
            "BVH cannot say that joint 'base' has a column 'Zrotation' that moves nothing");
  skeleton.coordinates[3].channel = "JOINT";
  EXPECT_EQ(refusal_of(skeleton).code, "BVH036");
  skeleton.joints[0].tips = {{"a}b", {0, 0, 0}}};
  EXPECT_EQ(refusal_of(skeleton).message,
            "BVH cannot say that joint 'base' has a tip whose name spans lines or holds a brace");
  skeleton.joints[0].name = "a\nb";
  EXPECT_EQ(refusal_of(skeleton).code, "BVH036");
}

}  // namespace
}  // namespace kinefile::test
