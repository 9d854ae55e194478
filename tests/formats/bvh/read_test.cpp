// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "kinefile/bvh.hpp"
#include "kinefile/kinematics.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

const std::string kGood = bvh_with_rows({"1 2 3 4 5 6 7 8 9", "2 3 4 5 6 7 8 9 10"});

std::vector<std::string> codes(const std::string& text, ReadOptions options = {}) {
  return codes_of(read_bvh(text, std::move(options)).diagnostics);
}

ReadOptions lenient() { return {.lenient = true}; }

/// Checks that a text is an error with this code, and that --lenient repairs it with a warning.
const Motion& expect_repaired(ReadText& repaired, const std::string& text,
                              const std::string& code) {
  EXPECT_EQ(codes(text), std::vector<std::string>{code});
  EXPECT_FALSE(read_bvh(text).document);
  repaired = read_bvh(text, lenient());
  EXPECT_EQ(codes_of(repaired.diagnostics), std::vector<std::string>{code});
  return repaired.motion();
}

TEST(BvhRead, KeepsEveryNumberInPlace) {
  const Motion motion = motion_of(kGood);
  EXPECT_EQ(motion.clip.num_frames, 2u);
  EXPECT_EQ(motion.clip.values,
            (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
  EXPECT_EQ(frame_time(motion.clip.timeline), 0.04);
  EXPECT_TRUE(validate(motion.skeleton));
  EXPECT_EQ(motion.skeleton.joints[1].parent, 0u);
  EXPECT_EQ(motion.skeleton.joints[1].offset, Vec3(1, 2, 3));
  EXPECT_EQ(motion.skeleton.joints[1].tips[0].offset, Vec3(0, 4, 0));
  EXPECT_EQ(motion.skeleton.coordinates[3].channel, "Zrotation");
}

TEST(BvhRead, LenientGivesAJointWithoutANameOne) {
  for (const char* nameless : {"JOINT", "JOINT ", "JOINT\n\n"}) {
    ReadText read;
    const Motion& motion = expect_repaired(read, replaced(kGood, "JOINT A", nameless), "BVH004");
    EXPECT_EQ(motion.skeleton.joints[1].name, "joint1") << nameless;
    EXPECT_EQ(motion.clip.values, motion_of(kGood).clip.values);
    EXPECT_NE(write_to_string(*read.document).find("JOINT joint1\n"), std::string::npos);
  }
  ReadText read;
  EXPECT_EQ(
      expect_repaired(read, replaced(kGood, "ROOT Hips", "ROOT"), "BVH004").skeleton.joints[0].name,
      "joint0");
  EXPECT_FALSE(read_bvh(replaced(kGood, "JOINT A\n", "JOINT }\n"), lenient()).document);
}

TEST(BvhRead, LenientPassesOverChannels0InAnEndSite) {
  ReadText read;
  const std::string site = "OFFSET 0 4 0";
  for (const std::string& both : {"CHANNELS 0\n" + site, site + "\nCHANNELS 0"}) {
    const Motion& motion = expect_repaired(read, replaced(kGood, site, both), "BVH007");
    EXPECT_EQ(motion.clip.values, motion_of(kGood).clip.values);
    EXPECT_EQ(motion.skeleton.joints[1].tips[0].offset, Vec3(0, 4, 0));
  }
  // Channels of an End Site would have columns.
  for (const char* channels : {"CHANNELS 1 Xrotation", "CHANNELS 0 Xrotation", "CHANNELS"}) {
    EXPECT_FALSE(read_bvh(replaced(kGood, site, site + "\n" + channels), lenient()).document)
        << channels;
  }
}

/// `kGood` with some of the braces right before MOTION.
std::string with_last_braces(const std::string& braces) {
  const std::size_t motion = kGood.find("MOTION");
  const std::size_t last = kGood.find_last_not_of(" }\n", motion - 1) + 1;
  return kGood.substr(0, last) + "\n" + braces + kGood.substr(motion);
}

TEST(BvhRead, LenientClosesWhatIsOpenAtTheEndOfTheHierarchy) {
  ReadText read;
  EXPECT_EQ(motion_of(with_last_braces("}\n}\n}\n")).clip.num_frames, 2u);
  const Motion& motion = expect_repaired(read, with_last_braces("}\n}\n"), "BVH003");
  EXPECT_EQ(motion.clip.values, motion_of(kGood).clip.values);
  EXPECT_EQ(text_of(read_bvh(with_last_braces("}\n}\n")).diagnostics),
            "t.bvh:15:1: error[BVH003]: expected '}' to close 'Hips', found 'MOTION'; --lenient "
            "closes it\n  MOTION\n  ^\n")
      << "tells what helps";
  // Every missing brace is a warning of its own, also those of End Sites.
  for (const auto& [braces, count] : {std::pair("}\n", 2u), std::pair("", 3u)}) {
    const ReadText all = read_bvh(with_last_braces(braces), lenient());
    EXPECT_EQ(codes_of(all.diagnostics), std::vector<std::string>(count, "BVH003"));
    EXPECT_EQ(all.motion().clip.values, motion_of(kGood).clip.values);
    EXPECT_FALSE(read_bvh(with_last_braces(braces)).document);
  }
  // MOTION may be missing, too; the end of the file is another thing.
  EXPECT_TRUE(read_bvh(replaced(with_last_braces("}\n}\n"), "MOTION\n", ""), lenient()).document);
  const std::string cut = with_last_braces("}\n}\n");
  EXPECT_FALSE(read_bvh(cut.substr(0, cut.find("MOTION")), lenient()).document);
}

TEST(BvhRead, ABraceThatMayBeMissingFurtherUpIsNotMadeUp) {
  // Without the brace that closes Left, Right would hang on it.
  const auto two_legs = [](const std::string& after_left, const std::string& indentation) {
    return "HIERARCHY\nROOT Hips\n{\n OFFSET 0 0 0\n CHANNELS 1 Xrotation\n" + indentation +
           "JOINT Left\n{\nOFFSET 1 0 0\nCHANNELS 1 Xrotation\n" + after_left + indentation +
           "JOINT Right\n{\nOFFSET -1 0 0\nCHANNELS 1 Xrotation\nEnd Site\n{\nOFFSET 0 -1 0\n}\n"
           "}\n}\nMOTION\nFrames: 1\nFrame Time: 1\n1 2 3\n";
  };
  const std::string site = "End Site\n{\nOFFSET 0 -1 0\n}\n";
  EXPECT_TRUE(read_bvh(two_legs(site + "}\n", " ")).document);
  EXPECT_FALSE(read_bvh(two_legs(site, " "), lenient()).document) << "an End Site, then a joint";
  const std::string shank = "  JOINT Shank\n{\nOFFSET 0 -1 0\nCHANNELS 1 Xrotation\n}\n";
  const std::string rows = "1 2 3\n";
  const std::string whole = replaced(two_legs(shank + "}\n", " "), rows, "1 2 3 4\n");
  EXPECT_TRUE(read_bvh(whole).document);
  const std::string lacking = replaced(two_legs(shank, " "), rows, "1 2 3 4\n");
  EXPECT_FALSE(read_bvh(lacking, lenient()).document) << "Right is indented like Left";
}

TEST(BvhRead, AMissingPositionComponentKeepsItsOffset) {
  std::string text = replaced(kGood, "OFFSET 0 0 0", "OFFSET 5 6 7");
  text = replaced(text, "CHANNELS 6 Xposition Yposition Zposition", "CHANNELS 4 Yposition");
  text = replaced(replaced(text, "\n1 2 3", "\n35"), "\n2 3 4", "\n34");
  const Motion motion = motion_of(text);
  const WorldPoses poses = forward_kinematics(motion.skeleton, motion.clip);
  EXPECT_EQ(Vec3(poses.positions[0], poses.positions[1], poses.positions[2]), Vec3(5, 35, 7));
}

TEST(BvhRead, ScaleChannelsScaleWhereChildrenSit) {
  std::string text = replaced(kGood, "CHANNELS 6 Xposition Yposition Zposition Zrotation",
                              "CHANNELS 7 Xposition Yposition Zposition Yscale Zrotation");
  text = replaced(replaced(text, "\n1 2 3", "\n0 0 0 10"), "\n2 3 4", "\n0 0 0 1");
  text = replaced(text, "0 0 0 10 4 5 6", "0 0 0 10 0 0 0");
  const Motion motion = motion_of(text);
  const WorldPoses poses = forward_kinematics(motion.skeleton, motion.clip);
  EXPECT_EQ(Vec3(poses.positions[3], poses.positions[4], poses.positions[5]), Vec3(1, 20, 3));
}

TEST(BvhRead, RepeatedAxesTurnTwice) {
  std::string text = replaced(kGood, "CHANNELS 3 Zrotation Xrotation Yrotation",
                              "CHANNELS 3 Zrotation Zrotation Zrotation");
  text = replaced(text, "\n1 2 3 4 5 6 7 8 9", "\n0 0 0 0 0 0 20 30 40");
  const ReadText read = read_bvh(text);
  EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"BVH039"});
  const Motion& motion = read.motion();
  const WorldPoses poses =
      forward_kinematics(motion.skeleton, motion.clip, {.num_frames = 1, .tips = true});
  EXPECT_LT((Vec3(poses.tips[0], poses.tips[1], poses.tips[2]) - Vec3(1 - 4, 2, 3)).norm(), 1e-14);
}

TEST(BvhRead, EveryLineEndIsOne) {
  for (const std::string line_end : {"\r\n", "\r"}) {
    std::string text;
    for (const char c : kGood) text += c == '\n' ? line_end : std::string(1, c);
    EXPECT_EQ(motion_of(text).clip.values, motion_of(kGood).clip.values);
  }
  std::string mixed = replaced(kGood, "{\n", "{\r\n");
  EXPECT_EQ(motion_of(replaced(mixed, "9\n", "9\r")).clip.values, motion_of(kGood).clip.values);
}

TEST(BvhRead, EncodingsGiveTheSameNames) {
  const std::string name = "\xE5\x8F\xB3\xE8\x85\x95";
  const std::string utf8 = replaced(kGood, "JOINT A", "JOINT " + name);
  EXPECT_EQ(motion_of(utf8).skeleton.joints[1].name, name);
  ReadOptions options;
  options.encoding = "cp932";
  const ReadText cp932 = read_bvh(replaced(kGood, "JOINT A", "JOINT \x89\x45\x98\x72"), options);
  EXPECT_EQ(cp932.motion().skeleton.joints[1].name, name);
  EXPECT_EQ(fact_of(*cp932.document, "encoding"), "cp932");
  std::string utf16 = "\xFE\xFF";
  for (const char c : kGood) utf16 += {'\0', c};
  EXPECT_EQ(motion_of(utf16).clip.values, motion_of(kGood).clip.values);
}

TEST(BvhRead, SeveralRootsAndAnyChannels) {
  const Motion motion = motion_of(fixture("bvh/valid/two_roots.bvh"));
  ASSERT_EQ(motion.skeleton.joints.size(), 4u);
  EXPECT_EQ(motion.skeleton.joints[0].parent, kNoParent);
  EXPECT_EQ(motion.skeleton.joints[2].parent, kNoParent);
  EXPECT_EQ(motion.skeleton.joints[3].parent, 2u);
  EXPECT_EQ(motion.clip.num_coordinates, 4u);
}

TEST(BvhRead, AMotionWithoutColumnsHasAnEmptyLineAFrame) {
  const std::string head =
      "HIERARCHY\nROOT r\n{\nOFFSET 0 1 0\nCHANNELS 0\n}\nMOTION\nFrames: 3\nFrame Time: 0.1\n";
  EXPECT_EQ(motion_of(head + "\n\n\n").clip.num_frames, 3u);
  EXPECT_EQ(motion_of(head + " \n\t\n\n").clip.num_frames, 3u) << "bvhio ends rows with a blank";
  EXPECT_EQ(codes(head), std::vector<std::string>{"BVH031"});
  EXPECT_EQ(codes(head + "1 2 3\n"), std::vector<std::string>{"BVH028"});
}

TEST(BvhRead, AHierarchyAloneIsASkeleton) {
  const std::string text = kGood.substr(0, kGood.find("MOTION"));
  const ReadText read = read_bvh(text);
  ASSERT_TRUE(read.document);
  EXPECT_EQ(kind_name(*read.document), "skeleton");
  EXPECT_EQ(codes(text), std::vector<std::string>{"BVH018"});
}

TEST(BvhRead, FpsStandsInForTheFrameTime) {
  ReadOptions options;
  options.fps = 25;
  EXPECT_EQ(frame_rate(read_bvh(kGood, options).motion().clip.timeline), 25);
  const std::string missing = replaced(kGood, "Frame Time: 0.04\n", "");
  EXPECT_EQ(codes(missing, options), std::vector<std::string>{});
  EXPECT_EQ(codes(missing), std::vector<std::string>{"BVH023"});
  EXPECT_EQ(frame_rate(read_bvh(missing).motion().clip.timeline), 30);
  const std::string zero = replaced(kGood, "Frame Time: 0.04", "Frame Time: 0");
  const ReadText read = read_bvh(zero, options);
  EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"BVH022"});
  EXPECT_EQ(frame_rate(read.motion().clip.timeline), 25);
}

TEST(BvhLenient, MissingOffset) {
  ReadText read;
  const Motion& motion = expect_repaired(read, replaced(kGood, "    OFFSET 1 2 3\n", ""), "BVH006");
  EXPECT_EQ(motion.skeleton.joints[1].offset, Vec3(0, 0, 0));
}

TEST(BvhLenient, UnknownChannel) {
  std::string text = replaced(kGood, "CHANNELS 3 Zrotation", "CHANNELS 4 Foo Zrotation");
  text = replaced(replaced(text, "6 7 8 9", "6 77 7 8 9"), "7 8 9 10", "7 77 8 9 10");
  ReadText read;
  const Motion& motion = expect_repaired(read, text, "BVH010");
  EXPECT_EQ(motion.skeleton.coordinates[6].channel, "Foo");
  EXPECT_EQ(motion.clip.row(0)[6], 77);
  EXPECT_EQ(num_dofs(motion.skeleton), 9u);
  const Motion plain = motion_of(kGood);
  EXPECT_EQ(forward_kinematics(motion.skeleton, motion.clip).positions,
            forward_kinematics(plain.skeleton, plain.clip).positions);
}

TEST(BvhLenient, DecimalCommas) {
  ReadText read;
  expect_repaired(read, replaced(kGood, "Frame Time: 0.04", "Frame Time: 0,04"), "BVH024");
  EXPECT_EQ(frame_time(read.motion().clip.timeline), 0.04);
  expect_repaired(read, replaced(kGood, "\n1 2 3", "\n1 2,5 3"), "BVH024");
  EXPECT_EQ(read.motion().clip.values[1], 2.5);
  expect_repaired(read, replaced(kGood, "OFFSET 1 2 3", "OFFSET 1 2 3,25"), "BVH024");
  EXPECT_EQ(read.motion().skeleton.joints[1].offset[2], 3.25);
}

TEST(BvhLenient, CountsThatAreNone) {
  ReadText read;
  EXPECT_EQ(
      expect_repaired(read, replaced(kGood, "Frames: 2", "Frames: -1"), "BVH019").clip.num_frames,
      2u);
  expect_repaired(read, replaced(kGood, "Frames: 2", "Frames: 1000000000"), "BVH032");
  EXPECT_EQ(read.motion().clip.num_frames, 2u);
  expect_repaired(read, replaced(kGood, "Frame Time: 0.04", "Frame Time: -1"), "BVH022");
  EXPECT_EQ(frame_rate(read.motion().clip.timeline), 30);
}

TEST(BvhLenient, RowsTooLongAndACutLastRow) {
  ReadText read;
  expect_repaired(read, replaced(kGood, "6 7 8 9\n", "6 7 8 9 99 98\n"), "BVH028");
  EXPECT_EQ(read.motion().clip.values, motion_of(kGood).clip.values);
  const std::string cut = kGood.substr(0, kGood.size() - 6);
  EXPECT_EQ(codes(cut), std::vector<std::string>{"BVH028"});
  const ReadText repaired = read_bvh(cut, lenient());
  EXPECT_EQ(codes_of(repaired.diagnostics), (std::vector<std::string>{"BVH028", "BVH031"}));
  EXPECT_EQ(repaired.motion().clip.num_frames, 1u);
}

TEST(BvhLenient, DoesNotInventNumbers) {
  EXPECT_FALSE(read_bvh(replaced(kGood, "\n1 2 3 4", "\n1 2 4"), lenient()).document)
      << "a short row that is not the last";
  EXPECT_FALSE(read_bvh(replaced(kGood, "\n1 2 3", "\n1 x 3"), lenient()).document);
  EXPECT_FALSE(read_bvh(replaced(kGood, "\n1 2 3", "\n1 1e999 3"), lenient()).document);
}

TEST(BvhRows, AStreamIsReadWhateverItsLineEnds) {
  std::string text = replaced(kGood, "1 2 3 4", "1 2 3\n4");
  EXPECT_EQ(read_bvh(text).motion().clip.values, motion_of(kGood).clip.values);
  EXPECT_EQ(codes(text), std::vector<std::string>{"BVH029"});
  text = replaced(kGood, "9\n2", "9 2");
  EXPECT_EQ(read_bvh(text).motion().clip.values, motion_of(kGood).clip.values);
  text = replaced(kGood, "9\n2 3", "9 nan\n3");
  const ReadText read = read_bvh(text);
  EXPECT_EQ(codes_of(read.diagnostics), (std::vector<std::string>{"BVH029", "BVH027"}));
  EXPECT_TRUE(std::isnan(read.motion().clip.values[9]));
}

TEST(BvhRows, AStreamMayHaveCommentsBehindItsLastNumber) {
  const std::string text = replaced(kGood, "1 2 3 4", "1 2 3\n# here\n4") + "# the end\n\n# yes\n";
  EXPECT_EQ(read_bvh(text).motion().clip.values, motion_of(kGood).clip.values);
}

TEST(BvhRows, ADroppedRowLeavesNoValues) {
  const ReadText read = read_bvh(kGood + "1 2 3\n", lenient());
  ASSERT_TRUE(read.document) << text_of(read.diagnostics);
  EXPECT_EQ(read.motion().clip.values, motion_of(kGood).clip.values);
}

TEST(BvhRows, AStreamMustHoldAllItsNumbers) {
  EXPECT_EQ(codes(replaced(kGood, "1 2 3 4", "1 2 3\n4 4")),
            (std::vector<std::string>{"BVH028", "BVH028"}));
}

TEST(BvhRows, EveryFaultIsReported) {
  std::string text = replaced(kGood, "\n1 2 3", "\nx 2 y");
  text = replaced(text, "\n2 3 4", "\n2 3 4 5");
  EXPECT_EQ(codes(text), (std::vector<std::string>{"BVH025", "BVH025", "BVH028"}));
}

TEST(BvhRows, TextAfterTheFramesIsPassedOverButNotRows) {
  EXPECT_EQ(codes(kGood + "the end\n"), std::vector<std::string>{"BVH033"});
  EXPECT_EQ(codes(kGood + "the end\n1 2 3 4 5 6 7 8 9\n"),
            (std::vector<std::string>{"BVH025", "BVH025"}));
  EXPECT_EQ(codes(kGood + "\x1A"), std::vector<std::string>{});
}

TEST(BvhRows, MoreAndFewerRowsThanFrames) {
  const ReadText more = read_bvh(replaced(kGood, "Frames: 2", "Frames: 1"));
  EXPECT_EQ(more.motion().clip.num_frames, 2u);
  EXPECT_EQ(codes_of(more.diagnostics), std::vector<std::string>{"BVH030"});
  const ReadText fewer = read_bvh(replaced(kGood, "Frames: 2", "Frames: 9"));
  EXPECT_EQ(fewer.motion().clip.num_frames, 2u);
  EXPECT_EQ(codes_of(fewer.diagnostics), std::vector<std::string>{"BVH031"});
}

TEST(BvhRead, NestingHasALimit) {
  const auto chain = [](int depth) {
    std::string text = "HIERARCHY\n";
    for (int d = 0; d < depth; ++d) {
      text += (d == 0 ? "ROOT j" : "JOINT j") + std::to_string(d) +
              " { OFFSET 0 1 0 CHANNELS 1 Zrotation\n";
    }
    text += std::string(static_cast<std::size_t>(depth), '}') +
            "\nMOTION\nFrames: 1\nFrame Time: 0.1\n";
    for (int d = 0; d < depth; ++d) text += "0 ";
    return text;
  };
  EXPECT_EQ(motion_of(chain(1000)).skeleton.joints.size(), 1000u);
  EXPECT_EQ(codes(chain(1001)), std::vector<std::string>{"BVH012"});
  EXPECT_EQ(codes(chain(100'000)), std::vector<std::string>{"BVH012"});
}

TEST(BvhLenient, CommasAreHeldToTheSameRules) {
  for (const char* time : {"0,0", "-0,5"}) {
    ReadText read;
    expect_repaired(read, replaced(kGood, "Frame Time: 0.04", std::string("Frame Time: ") + time),
                    "BVH022");
    EXPECT_EQ(frame_rate(read.motion().clip.timeline), 30);
  }
  EXPECT_EQ(codes(replaced(kGood, "Frame Time: 0.04", "Frame Time: 1,#INF"), lenient()),
            std::vector<std::string>{"BVH022"});
  EXPECT_FALSE(read_bvh(replaced(kGood, "OFFSET 1 2 3", "OFFSET 1,#INF 2 3"), lenient()).document);
}

TEST(BvhRead, DiagnosticsOfOneFileAreNotHeldAgainstTheNext) {
  Diagnostics diagnostics;
  EXPECT_FALSE(find_format("bvh")->read("what", {}, diagnostics));
  EXPECT_TRUE(find_format("bvh")->read(kGood, {}, diagnostics));
  EXPECT_EQ(codes_of(diagnostics), std::vector<std::string>{"BVH001"});
}

TEST(BvhRead, AJointHasOnlySoManyChannels) {
  std::string text = "HIERARCHY\nROOT r\n{\nOFFSET 0 0 0\nCHANNELS 3";
  for (int i = 0; i < 1001; ++i) text += " Xrotation";
  EXPECT_EQ(codes(text + "\n}\nMOTION\nFrames: 0\nFrame Time: 0.1\n"),
            std::vector<std::string>{"BVH008"});
}

TEST(BvhRead, OneFaultOfTheChannelsIsNotRepeatedForEveryRow) {
  const std::string twice = "    CHANNELS 1 Zrotation\n    OFFSET 1 2 3\n";
  EXPECT_EQ(codes(replaced(kGood, "    OFFSET 1 2 3\n", twice)),
            std::vector<std::string>{"BVH007"});
}

// A line may be as long as the file: what is said of a million words must not look at all of it
// for each. Quadratic, this would take minutes.
TEST(BvhRead, AMillionFaultsInOneLineAreNoTrouble) {
  std::string words;
  for (int i = 0; i < 1'000'000; ++i) words += "x ";
  const ReadText read = read_bvh(bvh_with_rows({words}));
  EXPECT_EQ(read.diagnostics.count_of("BVH025", Severity::Error), 1'000'000u);
  std::string nans = "\xFF\xFE";
  for (int i = 0; i < 500'000; ++i) nans += std::string("\x00\xD8", 2);
  EXPECT_GT(read_bvh(nans).diagnostics.count_of("TXT001", Severity::Warning), 499'000u);
}

TEST(BvhRead, InputIsNotModified) {
  const std::string copy = kGood;
  motion_of(kGood);
  EXPECT_EQ(kGood, copy);
}

}  // namespace
}  // namespace kinefile::test
