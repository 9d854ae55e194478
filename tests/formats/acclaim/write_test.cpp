// SPDX-License-Identifier: MIT
// What is written reads back: bit for bit for files of its own, joint by joint for others.

#include <cstring>

#include "formats/acclaim/arm.hpp"
#include "kinefile/kinefile.hpp"
#include "walk.hpp"

namespace kinefile::test {
namespace {

const std::string kTwoFrames =
    ":DEGREES\n1\nroot 1 2 3 4 5 6\nb 7 8\n2\nroot 1 2 3 4 5 6\nb 9 10\n";

Document read_document(const std::string& text, const std::string& skeleton) {
  const ReadText read = read_acclaim("amc", text, skeleton);
  EXPECT_TRUE(read.document) << text_of(read.diagnostics);
  return read.document.value_or(Document{});
}

Document adapted(Document document, const std::string& format, Diagnostics& diagnostics) {
  auto result = adapted_to(*find_format(format), std::move(document), {}, diagnostics);
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return result ? std::move(*result) : Document{};
}

/// Reads back what a document is written as.
Document written_and_read(const Document& document) {
  return read_document(write_to_string(document, "amc"), write_to_string(document, "asf"));
}

/// \param only_in_first  joints that have other names in the second
double largest_distance(const Document& a, const Document& b,
                        const std::vector<std::string>& only_in_first = {}) {
  const MotionComparison comparison =
      compare_motions(std::get<Motion>(a.content), std::get<Motion>(b.content));
  EXPECT_EQ(comparison.only_in_first, only_in_first);
  return std::max(comparison.distance.value, comparison.tip_distance.value);
}

TEST(AcclaimWrite, KeepsWhatTheFileSaid) {
  std::string skeleton = asf_with(
      "axis 0 0 30 ZXY\ndof rx rz\nlimits (-inf 20)\n(-7 7)\nbodymass 3\ncofmass 0.5\nweight 5\n");
  skeleton = "# made by hand\n" + skeleton + ":skin\n  a.skin\n:colour\n  red\n";
  const std::string text =
      "# note\n:FULLY-SPECIFIED\n:COLOUR blue\n:SAMPLES-PER-SECOND 59.94\n" + kTwoFrames;
  const Document document = read_document(text, skeleton);
  const std::string asf = write_to_string(document, "asf");
  const std::string amc = write_to_string(document, "amc");
  for (const std::string word :
       {"# made by hand\n", "limits (-inf 20)\n", "bodymass 3\n", "cofmass 0.5\n", "weight 5\n",
        ":skin\n  a.skin\n", ":colour\n  red\n", "axis 0 0 30 ZXY\n", "length 0.45\n"}) {
    EXPECT_NE(asf.find(word), std::string::npos) << word << asf;
  }
  for (const std::string word : {"# note\n", ":COLOUR blue\n", ":SAMPLES-PER-SECOND 59.94\n"}) {
    EXPECT_NE(amc.find(word), std::string::npos) << word << amc;
  }
  const Document again = read_document(amc, asf);
  EXPECT_EQ(write_to_string(again, "asf"), asf);
  EXPECT_EQ(write_to_string(again, "amc"), amc);
}

TEST(AcclaimWrite, ChannelsThatBvhRepeatsBecomeOne) {
  const std::string bvh =
      "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Xposition Zrotation "
      "Xrotation Zrotation\nJOINT b\n{\nOFFSET 0 1 0\nCHANNELS 3 Yrotation Zrotation Zrotation\n"
      "End Site\n{\nOFFSET 0 1 0\n}\n}\n}\nMOTION\nFrames: 2\nFrame Time: 0.05\n"
      "1 2 3 10 20 30 4 5 6\n1 1 1 15 25 35 14 15 16\n";
  Diagnostics diagnostics;
  const auto document = find_format("bvh")->read(bvh, {}, diagnostics);
  ASSERT_TRUE(document) << text_of(diagnostics);
  const Document bones = adapted(*document, "amc", diagnostics);
  EXPECT_LT(largest_distance(*document, written_and_read(bones), {"a"}), 1e-12);
}

TEST(AcclaimWrite, EmptyLinesOfAKeptSectionStay) {
  const std::string skeleton = asf_with("axis 0 0 0 XYZ\ndof rx rz\n") + ":colour\n  red\n\n\n";
  const Document document = read_document(kTwoFrames, skeleton);
  const std::string asf = write_to_string(document, "asf");
  EXPECT_TRUE(asf.ends_with(":colour\n  red\n\n\n")) << asf;
  EXPECT_EQ(write_to_string(read_document(kTwoFrames, asf), "asf"), asf);
}

TEST(AcclaimWrite, AZeroInACommentDoesNotMakeItUtf16) {
  using namespace std::string_literals;
  const std::string skeleton = asf_with("axis 0 0 0 XYZ\ndof rx rz\n");
  const Document document = read_document("  \n#\0a\0\n"s + kTwoFrames, skeleton);
  const std::string amc = write_to_string(document, "amc");
  EXPECT_TRUE(amc.starts_with("#\uFFFDa\uFFFD\n")) << amc;
  EXPECT_EQ(write_to_string(read_document(amc, skeleton), "amc"), amc);
}

TEST(AcclaimWrite, AnAssumedRateIsNotPutIntoTheFilesMouth) {
  Document document = read_document(kTwoFrames, asf_with("axis 0 0 0 XYZ\ndof rx rz\n"));
  EXPECT_EQ(write_to_string(document, "amc").find("SAMPLES"), std::string::npos);
  std::get<Motion>(document.content).clip.timeline.given = FrameRate{60};
  EXPECT_NE(write_to_string(document, "amc").find(":SAMPLES-PER-SECOND 60\n"), std::string::npos);
}

TEST(AcclaimWrite, ARateThatNoReaderTakesIsRefused) {
  Document document = read_document(kTwoFrames, asf_with("axis 0 0 0 XYZ\ndof rx rz\n"));
  Timeline& timeline = std::get<Motion>(document.content).clip.timeline;
  for (const double seconds : {1e300, 1e-320, 1.1e9, 0.9e-9}) {
    timeline.given = FrameTime{seconds};
    Diagnostics diagnostics;
    const auto written = find_format("amc")->write(
        document, {}, [](std::string_view) { return true; }, diagnostics);
    ASSERT_FALSE(written) << seconds;
    EXPECT_EQ(written.error().code, "ASF020");
    EXPECT_EQ(written.error().kind, ErrorKind::DataLoss);
  }
  timeline.given = FrameRate{1e-9};
  const Document again = written_and_read(document);
  EXPECT_EQ(frame_rate(std::get<Motion>(again.content).clip.timeline), 1e-9);
}

TEST(AcclaimWrite, ForcedBonesKeepTheirHeaderAndTheirWords) {
  const std::string text = ":DEGREES\n:FORCE-ALL-JOINTS-BE-3DOF\n1\nroot 0 0 0 0 0 0\nb 10 20 30\n";
  const Document document = read_document(text, asf_with("axis 0 0 30 XYZ\ndof ry\n"));
  const std::string asf = write_to_string(document, "asf");
  const std::string amc = write_to_string(document, "amc");
  EXPECT_NE(asf.find("dof ry\n"), std::string::npos) << asf;
  EXPECT_NE(amc.find(":FORCE-ALL-JOINTS-BE-3DOF\n"), std::string::npos);
  EXPECT_NE(amc.find("b 10 20 30\n"), std::string::npos) << amc;
}

TEST(AcclaimWrite, SkeletonsThatAreNoBonesAreRefusedWithTheReason) {
  const ReadText bvh = read_bvh(bvh_with_rows({"0 0 0 0 0 0 1 2 3"}));
  Diagnostics diagnostics;
  const auto refused = find_format("asf")->write(
      *bvh.document, {}, [](std::string_view) { return true; }, diagnostics);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "ASF020");
  Document skeleton;
  skeleton.content = Skeleton{};
  const auto alone = find_format("amc")->write(
      skeleton, {}, [](std::string_view) { return true; }, diagnostics);
  ASSERT_FALSE(alone);
  EXPECT_EQ(alone.error().code, "AMC017");
}

TEST(AcclaimConvert, TheWalkBecomesBonesAndAHierarchyAgain) {
  Document walk;
  walk.content = examples::make_walk({.num_frames = 30});
  Diagnostics diagnostics;
  const Document bones = adapted(walk, "amc", diagnostics);
  EXPECT_EQ(diagnostics.count(Severity::Warning), 0u) << text_of(diagnostics);
  const Document back = written_and_read(bones);
  EXPECT_LE(largest_distance(walk, back, {"Hips"}), 1e-11) << "it is called root";
  const Document hierarchy = adapted(back, "bvh", diagnostics);
  const ReadText bvh = read_bvh(write_to_string(hierarchy, "bvh"));
  ASSERT_TRUE(bvh.document) << text_of(bvh.diagnostics);
  EXPECT_LE(largest_distance(walk, *bvh.document), 1e-11);
  const Motion first = read_bvh(write_to_string(walk)).motion();  // joints depth first
  const MotionComparison comparison = compare_motions(first, bvh.motion());
  EXPECT_TRUE(comparison.only_in_second.empty()) << "helper bones are taken out";
  EXPECT_TRUE(first.clip.values == bvh.motion().clip.values);
  for (std::size_t j = 1; j < first.skeleton.joints.size(); ++j) {
    const Joint& joint = bvh.motion().skeleton.joints[j];
    EXPECT_EQ(joint.parent, first.skeleton.joints[j].parent);
    EXPECT_LE((joint.offset - first.skeleton.joints[j].offset).norm(), 1e-14);
    EXPECT_EQ(joint.tips.size(), first.skeleton.joints[j].tips.size());
  }
}

TEST(AcclaimConvert, ValuesThatNeedNoArithmeticKeepTheirBits) {
  Document walk;
  walk.content = examples::make_walk({.num_frames = 5});
  Diagnostics diagnostics;
  const Document bones = adapted(walk, "amc", diagnostics);
  const Motion& a = std::get<Motion>(walk.content);
  const Motion& b = std::get<Motion>(bones.content);
  ASSERT_EQ(a.clip.num_coordinates, b.clip.num_coordinates);
  EXPECT_EQ(std::memcmp(a.clip.values.data(), b.clip.values.data(),
                        a.clip.values.size() * sizeof(double)),
            0);
}

TEST(AcclaimConvert, ABoneThatGrowsMovesItsChildren) {
  // b is 2 long and grows by 1.5 along y; its child c is 1 long along x.
  const std::string skeleton =
      ":version 1.10\n:root\norder TX TY TZ RX RY RZ\naxis XYZ\n:bonedata\n"
      "begin id 1 name b direction 0 1 0 length 2 axis 0 0 0 XYZ dof l rz end\n"
      "begin id 2 name c direction 1 0 0 length 1 axis 0 0 0 XYZ dof rz end\n"
      ":hierarchy\nbegin\nroot b\nb c\nend\n";
  const Document document = read_document(
      ":DEGREES\n1\nroot 0 0 0 0 0 0\nb 1.5 90\nc 10\n2\nroot 0 0 0 0 0 0\nb -1 30\nc 20\n",
      skeleton);
  Diagnostics diagnostics;
  const Document hierarchy = adapted(document, "bvh", diagnostics);
  const ReadText bvh = read_bvh(write_to_string(hierarchy, "bvh"));
  ASSERT_TRUE(bvh.document) << text_of(bvh.diagnostics);
  EXPECT_LE(compare_motions(std::get<Motion>(document.content), bvh.motion()).distance.value,
            1e-12);
}

TEST(AcclaimConvert, PositionsOfOtherJointsThanTheRoot) {
  // A moves by its channels, around its OFFSET; it becomes tx ty tz, which rest at 0.
  const std::string text =
      "HIERARCHY\nROOT r\n{\nOFFSET 0 1 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nJOINT A\n{\n"
      "OFFSET 1 2 3\nCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
      "End Site\n{\nOFFSET 0 1 0\n}\n}\n}\nMOTION\nFrames: 2\nFrame Time: 0.01\n"
      "10 20 30 1 2 4 5 6 7\n10 20 30 1.5 2 3 5 6 7\n";
  const ReadText bvh = read_bvh(text);
  Diagnostics diagnostics;
  const Document bones = adapted(*bvh.document, "amc", diagnostics);
  EXPECT_EQ(diagnostics.count(Severity::Warning), 1u) << text_of(diagnostics);
  const Document back = written_and_read(bones);
  EXPECT_LE(largest_distance(*bvh.document, back, {"r"}), 1e-12) << "the root is called root";
}

TEST(AcclaimConvert, OntoAnotherSkeletonSaysWhatCannotBe) {
  // The bone b can turn about x alone; the joint A of the other motion turns about z by 30 degrees.
  Motion motion = read_bvh(bvh_with_rows({"1 2 3 0 0 0 30 20 10"})).motion();
  const ReadText asf = read_acclaim("asf", asf_with("axis 0 0 0 XYZ\ndof rx\n"));
  Diagnostics diagnostics;
  EXPECT_EQ(shape::onto_skeleton(motion, skeleton_of(*asf.document), diagnostics).error().code,
            "BRG004");
  motion.skeleton.joints[1].name = "B";
  const auto moved = shape::onto_skeleton(motion, skeleton_of(*asf.document), diagnostics);
  ASSERT_TRUE(moved);
  const std::string told = text_of(diagnostics);
  EXPECT_NE(told.find("joint 'b' cannot turn as it did"), std::string::npos) << told;
  EXPECT_NE(told.find("positions are taken over as they are"), std::string::npos) << told;
  EXPECT_EQ(moved->clip.row(0)[1], 2);
}

TEST(AcclaimConvert, OntoItsOwnBonesNothingIsLost) {
  Document walk;
  walk.content = examples::make_walk({.num_frames = 10});
  Diagnostics diagnostics;
  const Document bones = adapted(walk, "amc", diagnostics);
  const auto moved =
      shape::onto_skeleton(std::get<Motion>(walk.content), skeleton_of(bones), diagnostics);
  ASSERT_TRUE(moved);
  Document again;
  again.content = *moved;
  EXPECT_LE(largest_distance(walk, again, {"Hips"}), 1e-11) << text_of(diagnostics);
}

TEST(AcclaimConvert, RadiansBecomeDegreesInBvh) {
  const Document document = read_document(
      ":RADIANS\n1\nroot 0 0 0 0.1 0.2 0.3\nb 1 -2\n2\nroot 0 0 0 0.1 0.2 0.3\nb 1.5 -2\n",
      asf_with("axis 0 0 0 XYZ\ndof rx rz\n"));
  Diagnostics diagnostics;
  const ReadText bvh = read_bvh(write_to_string(adapted(document, "bvh", diagnostics), "bvh"));
  ASSERT_TRUE(bvh.document) << text_of(bvh.diagnostics);
  EXPECT_LE(largest_distance(document, *bvh.document), 1e-14);
}

}  // namespace
}  // namespace kinefile::test
