// SPDX-License-Identifier: MIT
// Every way in which real files differ, and those that no public file shows: each with the numbers
// that must come out, derived beside it.

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/acclaim/arm.hpp"
#include "formats/acclaim/kept.hpp"
#include "kinefile/kinematics.hpp"
#include "kinefile/limits.hpp"

namespace kinefile::test {
namespace {

const std::string kHeader = ":FULLY-SPECIFIED\n:DEGREES\n";

/// Where the bone `b` starts and ends in the first frame.
struct Placed {
  Vec3 start;
  Vec3 end;
};

Placed place(const Motion& motion, std::size_t frame = 0) {
  const WorldPoses poses = forward_kinematics(
      motion.skeleton, motion.clip, {.first_frame = frame, .num_frames = 1, .tips = true});
  const double* p = &poses.positions[3];
  const double* t = poses.tips.data();
  return {Vec3(p[0], p[1], p[2]), Vec3(t[0], t[1], t[2])};
}

void expect_near(const Vec3& actual, const Vec3& expected, double tolerance = 1e-12) {
  EXPECT_LE((actual - expected).norm(), tolerance)
      << actual.transpose() << " against " << expected.transpose();
}

TEST(AcclaimDialects, AnAxisWithoutItsOrderIsReadAsXyz) {
  const auto rest = [](const std::string& axis) {
    const ReadText read = read_acclaim("asf", asf_with(axis + "dof rx ry rz\n"));
    EXPECT_TRUE(read.document) << text_of(read.diagnostics);
    const Joint& bone = skeleton_of(*read.document).joints.at(1);
    return std::pair(codes_of(read.diagnostics), bone.dofs.at(0).axis);
  };
  const auto [no_codes, ordered] = rest("axis 10 20 30 XYZ\n");
  for (const char* axis :
       {"axis 10 20 30\n", "axis 10 20 30  # degrees\n", "axis (10, 20, 30)\n"}) {
    const auto [codes, axis_of_first] = rest(axis);
    EXPECT_EQ(codes.size(), no_codes.size() + 1) << axis;
    EXPECT_NE(std::find(codes.begin(), codes.end(), "ASF010"), codes.end()) << axis;
    EXPECT_EQ(axis_of_first, ordered) << axis;
  }
  // Another word in its place is a fault, and so is a root without an order.
  EXPECT_FALSE(read_acclaim("asf", asf_with("axis 10 20 30 XY\n")).document);
}

TEST(AcclaimDialects, AnglesTurnAboutTheAxesOfTheBone) {
  // C = Rz(90): x goes to y, so rx turns about the world's y, along the bone: nothing moves.
  // ry turns about -x: the end (0, 2, 0) goes to Rx(-90) (0, 2, 0) = (0, 0, -2).
  const std::string skeleton = asf_with("axis 0 0 90 XYZ\ndof rx ry rz\n");
  expect_near(place(amc_motion(kHeader + "1\nroot 0 0 0 0 0 0\nb 33 0 0\n", skeleton)).end,
              {0, 2, 0});
  expect_near(place(amc_motion(kHeader + "1\nroot 0 0 0 0 0 0\nb 0 90 0\n", skeleton)).end,
              {0, 0, -2});
}

TEST(AcclaimDialects, DofsAreAppliedFromTheFirstOn) {
  // rx ry rz makes Rz Ry Rx: Rx(90) takes (0, 2, 0) to (0, 0, 2), Ry(90) that to (2, 0, 0), Rz(90)
  // that to (0, 2, 0). rz ry rx makes Rx Ry Rz: Rz(90) to (-2, 0, 0), Ry(90) to (0, 0, 2), Rx(90)
  // to (0, -2, 0).
  const std::string frame = "1\nroot 0 0 0 0 0 0\nb 90 90 90\n";
  expect_near(place(amc_motion(kHeader + frame, asf_with("axis 0 0 0 XYZ\ndof rx ry rz\n"))).end,
              {0, 2, 0});
  expect_near(place(amc_motion(kHeader + frame, asf_with("axis 0 0 0 XYZ\ndof rz ry rx\n"))).end,
              {0, -2, 0});
}

TEST(AcclaimDialects, AxisTokensOtherThanXyz) {
  // The numbers are x y z whatever the token. ZYX applies z first: C = Rx(90) Ry(0) Rz(90), so
  // C e_x = Rx(90) (0, 1, 0) = (0, 0, 1). rx 90 turns about z: (0, 2, 0) goes to (-2, 0, 0).
  // XYZ applies x first: C = Rz(90) Rx(90), C e_x = Rz(90) (1, 0, 0) = (0, 1, 0): nothing moves.
  const std::string frame = "1\nroot 0 0 0 0 0 0\nb 90\n";
  expect_near(place(amc_motion(kHeader + frame, asf_with("axis 90 0 90 ZYX\ndof rx\n"))).end,
              {-2, 0, 0});
  expect_near(place(amc_motion(kHeader + frame, asf_with("axis 90 0 90 xyz\ndof rx\n"))).end,
              {0, 2, 0});
}

TEST(AcclaimDialects, RootOrderAndOrientation) {
  // Values in the order of the line. RZ RX: Rx(90) Rz(90): (0, 2, 0) to (-2, 0, 0), which Rx keeps.
  const std::string turned =
      asf_with("axis 0 0 0 XYZ\n", "axis XYZ\norder RZ RX TY\nposition 0 5 0\n");
  const Placed placed = place(amc_motion(kHeader + "1\nroot 90 90 1\n", turned));
  expect_near(placed.start, {0, 6, 0});  // position + T
  expect_near(placed.end, {-2, 6, 0});
  // An orientation turns the root's rotation, not its translation: G = C_orient R. C = Rx(90) takes
  // (0, 2, 0) to (0, 0, 2).
  const std::string oriented =
      asf_with("axis 0 0 0 XYZ\n",
               "order TX TY TZ RX RY RZ\naxis XYZ\nposition 1 1 0\norientation 90 0 0\n");
  const Placed at = place(amc_motion(kHeader + "1\nroot 7 8 9 0 0 0\n", oriented));
  expect_near(at.start, {8, 9, 9});
  expect_near(at.end, {8, 9, 11});
}

TEST(AcclaimDialects, LowerCaseOrder) {
  const std::string skeleton = asf_with("axis 0 0 0 XYZ\n", "order tx ty tz rx ry rz\naxis xyz\n");
  expect_near(place(amc_motion(kHeader + "1\nroot 1 2 3 0 0 90\n", skeleton)).end, {-1, 2, 3});
}

TEST(AcclaimDialects, TranslationsOfABoneAreAlongItsAxes) {
  // C = Rz(90): tx 3 moves the start by C (3, 0, 0) = (0, 3, 0); tz 1 by (0, 0, 1). The end goes
  // along: (0, 3, 1) + (0, 2, 0).
  const std::string skeleton = asf_with("axis 0 0 90 XYZ\ndof tx tz rx\n");
  const Placed placed = place(amc_motion(kHeader + "1\nroot 0 0 0 0 0 0\nb 3 1 0\n", skeleton));
  expect_near(placed.start, {0, 3, 1});
  expect_near(placed.end, {0, 5, 1});
}

TEST(AcclaimDialects, LengthIsAddedToTheBones) {
  // l 1.5 makes the bone 3.5 long; rz 90 turns it to -x. The order of values is the dof line's.
  const std::string skeleton = asf_with("axis 0 0 0 XYZ\ndof l rz\n");
  const Placed placed = place(amc_motion(kHeader + "1\nroot 0 0 0 0 0 0\nb 1.5 90\n", skeleton));
  expect_near(placed.start, {0, 0, 0});
  expect_near(placed.end, {-3.5, 0, 0});
}

TEST(AcclaimDialects, ForcedBonesHaveTheMissingRotationsBehindTheirOwn) {
  // dof ry rz: the values are ry rz rx, evaluated as Rz Ry Rx. rx 90 takes (0, 2, 0) to (0, 0, 2),
  // ry 90 that to (2, 0, 0), rz 0.
  const std::string skeleton = asf_with("axis 0 0 0 XYZ\ndof ry rz\n");
  const std::string header = kHeader + ":FORCE-ALL-JOINTS-BE-3DOF\n";
  expect_near(place(amc_motion(header + "1\nroot 0 0 0 0 0 0\nb 90 0 90\n", skeleton)).end,
              {2, 0, 0});
  // dof rz: rz rx ry. rz 90 last: (0, 0, 2) by rx, ry 90 to (2, 0, 0), rz 90 to (0, 2, 0).
  const std::string one = asf_with("axis 0 0 0 XYZ\ndof rz\n");
  expect_near(place(amc_motion(header + "1\nroot 0 0 0 0 0 0\nb 90 90 90\n", one)).end, {0, 2, 0});
}

TEST(AcclaimDialects, RadiansOfTheSkeletonOrOfTheMotion) {
  const std::string degrees = asf_with("axis 0 0 90 XYZ\ndof ry\n");
  const std::string radians =
      asf_with("axis 0 0 1.5707963267948966 XYZ\ndof ry\n", "order rx\naxis XYZ\n", "angle rad\n");
  const std::string half_turn = "1\nroot 0 0 0 0 0 0\nb 1.5707963267948966\n";
  expect_near(place(amc_motion(":RADIANS\n" + half_turn, degrees)).end, {0, 0, -2});
  expect_near(place(amc_motion("1\nroot 0\nb 1.5707963267948966\n", radians)).end, {0, 0, -2});
  expect_near(place(amc_motion(":DEGREES\n1\nroot 0\nb 90\n", radians)).end, {0, 0, -2});
}

TEST(AcclaimDialects, UnitsWithTwoBlanksAndTabs) {
  const std::string skeleton =
      asf_with("\taxis  0\t0 90   XYZ\n\tdof   ry\n", "order\tTX TY TZ RX RY RZ\naxis XYZ\n",
               "angle  deg\n\tlength\t0.45\n");
  expect_near(place(amc_motion("1\nroot\t0 0 0 0\t0 0\nb\t90\n", skeleton)).end, {0, 0, -2});
}

TEST(AcclaimDialects, ABoneOnOneLineAndEndBehindCofmass) {
  const std::string text =
      ":version 1.10\n:root\norder TX TY TZ RX RY RZ\naxis XYZ\n:bonedata\n"
      "begin id 1 name b direction 0 1 0 length 2 axis 0 0 0 XYZ dof rz limits (-1 1) bodymass 2.5 "
      "cofmass 0.3 end\n:hierarchy\nbegin\nroot b\nend\n";
  const ReadText read = read_acclaim("asf", text);
  ASSERT_TRUE(read.document) << text_of(read.diagnostics);
  EXPECT_EQ(codes_of(read.diagnostics), (std::vector<std::string>{"ASF024", "ASF024"}));
  EXPECT_EQ(skeleton_of(*read.document).metres_per_unit, 0);  // no :units, nothing to assume
  const acclaim::Bone* const bone = skeleton_of(*read.document).joints[1].kept.get<acclaim::Bone>();
  ASSERT_NE(bone, nullptr);
  EXPECT_EQ(bone->body_mass, "2.5");
  EXPECT_EQ(bone->cof_mass, "0.3");
}

TEST(AcclaimDialects, LimitsMayBeInfiniteOrMissing) {
  const ReadText read =
      read_acclaim("asf", asf_with("axis 0 0 0 XYZ\ndof rx ry\nlimits (-inf inf)\n (-1, 2.5)\n"));
  EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"ASF019"});
  const auto& limits = skeleton_of(*read.document).joints[1].kept.get<acclaim::Bone>()->limits;
  ASSERT_EQ(limits.size(), 2u);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(limits[0].low, -kInfinity);
  EXPECT_EQ(limits[0].high, kInfinity);
  EXPECT_EQ(limits[1].low, -1);
  EXPECT_EQ(limits[1].high, 2.5);
  EXPECT_EQ(codes_of(read_acclaim("asf", asf_with("axis 0 0 0 XYZ\ndof rx\n")).diagnostics),
            std::vector<std::string>{"ASF019"});
}

TEST(AcclaimDialects, LimitsBelongToTheWordsOfDofOneAfterTheOther) {
  const std::string asf =
      asf_with("axis 0 0 0 XYZ\ndof ry tx rx\nlimits (-inf 20)\n(-1 1)\n(30 -7)\n");
  const std::string amc =
      ":DEGREES\n1\nroot 0 0 0 0 0 0\nb 25 0 -8\n2\nroot 0 0 0 0 0 0\nb 0 2 0\n";
  const Motion motion = amc_motion(amc, asf);
  const auto breaches = find_limit_breaches(motion);
  ASSERT_EQ(breaches.size(), 3u);
  const auto channel = [&](const LimitBreach& breach) {
    const DegreeOfFreedom& dof = motion.skeleton.joints[breach.joint].dofs[breach.dof];
    return motion.skeleton.coordinates[dof.coordinate].channel;
  };
  EXPECT_EQ(channel(breaches[0]), "tx");
  EXPECT_EQ(breaches[0].worst_frame, 1u);
  EXPECT_EQ(channel(breaches[1]), "rx");
  EXPECT_EQ(breaches[1].limit, -7);
  EXPECT_EQ(channel(breaches[2]), "ry");
  EXPECT_EQ(breaches[2].limit, 20);
}

TEST(AcclaimDialects, LimitsAreInTheUnitOfTheSkeletonFile) {
  const std::string units = "length 0.45\nangle rad\n";
  const std::string asf = asf_with("axis 0 0 0 XYZ\ndof rx\nlimits (-1 0.5)\n",
                                   "order TX TY TZ RX RY RZ\naxis XYZ\n", units);
  const Motion motion = amc_motion(":DEGREES\n1\nroot 0 0 0 0 0 0\nb 29\n", asf);
  EXPECT_NEAR(motion.skeleton.joints[1].dofs[0].upper, 0.5 / kRadiansPerDegree, 1e-12);
  EXPECT_NEAR(motion.skeleton.joints[1].dofs[0].lower, -1 / kRadiansPerDegree, 1e-12);
}

TEST(AcclaimDialects, ParentsMayComeBehindTheirChildrenAndTwice) {
  const std::string text =
      ":version 1.10\n:root\norder TX TY TZ RX RY RZ\naxis XYZ\n:bonedata\n"
      "begin id 1 name hand direction 1 0 0 length 1 axis 0 0 0 XYZ end\n"
      "begin id 2 name arm direction 0 1 0 length 2 axis 0 0 0 XYZ end\n"
      "begin id 3 name leg direction 0 -1 0 length 4 axis 0 0 0 XYZ end\n"
      ":hierarchy\nbegin\nroot arm\narm hand\nroot leg\nend\n";
  const ReadText read = read_acclaim("asf", text);
  ASSERT_TRUE(read.document) << text_of(read.diagnostics);
  const Skeleton& skeleton = skeleton_of(*read.document);
  ASSERT_EQ(skeleton.joints.size(), 4u);
  EXPECT_EQ(skeleton.joints[1].name, "arm");
  EXPECT_EQ(skeleton.joints[2].name, "hand");
  EXPECT_EQ(skeleton.joints[2].parent, 1u);
  EXPECT_EQ(skeleton.joints[3].parent, 0u);
}

TEST(AcclaimDialects, TheHierarchyMayStandBeforeTheBones) {
  std::string text = asf_with("axis 0 0 0 XYZ\ndof rz\n");
  const std::size_t at = text.find(":hierarchy");
  const std::string hierarchy = text.substr(at);
  text = text.substr(0, at);
  text.insert(text.find(":bonedata"), hierarchy);
  const ReadText read = read_acclaim("asf", text);
  ASSERT_TRUE(read.document) << text_of(read.diagnostics);
  EXPECT_EQ(skeleton_of(*read.document).joints.size(), 2u);
  const ReadOptions lenient = {.lenient = true};
  EXPECT_TRUE(
      read_acclaim("asf", text + text.substr(text.find(":bonedata")), {}, lenient).document);
}

TEST(AcclaimDialects, ThreeDigitExponentsAndNegativeZero) {
  const Motion motion = amc_motion(kHeader + "1\nroot 0 -0 0 1e-014 0 0\nb -7.65321e-015\n",
                                   asf_with("axis 0 0 0 XYZ\ndof rz\n"));
  EXPECT_EQ(motion.clip.row(0)[6], -7.65321e-15);
  EXPECT_TRUE(std::signbit(motion.clip.row(0)[1]));
}

TEST(AcclaimDialects, MixedLineEndsAndARawLatin1Byte) {
  const std::string text =
      "#!OML:ASF X:\\f\xFCr Bonn\\t.ASF\r\n:FULLY-SPECIFIED\r\n:DEGREES\r\n1\n"
      "root 1 2 3 0 0 0\r\nb 5\r\n2\nroot 4 5 6 0 0 0\r\nb 6";
  const Motion motion = amc_motion(text, asf_with("axis 0 0 0 XYZ\ndof rz\n"));
  EXPECT_EQ(motion.clip.num_frames, 2u);
  EXPECT_EQ(motion.clip.row(1)[6], 6);
}

TEST(AcclaimDialects, FrameNumbersThatDoNotStartAtOneOrJump) {
  const std::string frame = "\nroot 0 0 0 0 0 0\nb 5\n";
  const ReadText read = read_acclaim("amc", kHeader + "99" + frame + "100" + frame + "4" + frame,
                                     asf_with("axis 0 0 0 XYZ\ndof rz\n"));
  ASSERT_TRUE(read.document);
  EXPECT_EQ(read.motion().clip.num_frames, 3u);
  EXPECT_EQ(read.motion().clip.timeline.first_frame_number, 99);
  EXPECT_EQ(read.diagnostics.count_of("AMC011", Severity::Warning), 1u);
}

TEST(AcclaimDialects, AMissingBoneHoldsItsValues) {
  const std::string text =
      kHeader + "1\nroot 0 0 0 0 0 0\n2\nroot 0 0 0 0 0 0\nb 7\n3\nroot 1 0 0 0 0 0\n";
  const ReadText read = read_acclaim("amc", text, asf_with("axis 0 0 0 XYZ\ndof rz\n"));
  ASSERT_TRUE(read.document);
  EXPECT_EQ(read.diagnostics.count_of("AMC009", Severity::Warning), 2u);
  EXPECT_EQ(read.motion().clip.row(0)[6], 0);
  EXPECT_EQ(read.motion().clip.row(2)[6], 7);
}

TEST(AcclaimDialects, AFrameThatIsLeftOutLeavesNoValues) {
  ReadOptions lenient;
  lenient.lenient = true;
  const std::string text =
      kHeader + "1\nroot 1 2 3 4 5 6\nb 7\n2\n3\nroot 2 2 3 4 5 6\n4\nb 9\n5\n";
  const ReadText read = read_acclaim("amc", text, asf_with("axis 0 0 0 XYZ\ndof rz\n"), lenient);
  ASSERT_TRUE(read.document) << text_of(read.diagnostics);
  EXPECT_EQ(read.motion().clip.num_frames, 3u);
  EXPECT_EQ(read.motion().clip.values, (Array<double>{1, 2, 3, 4, 5, 6, 7,  //
                                                      2, 2, 3, 4, 5, 6, 7,  //
                                                      2, 2, 3, 4, 5, 6, 9}));
}

TEST(AcclaimDialects, BonesInAnotherOrderAndAnotherCase) {
  const std::string text = kHeader + "1\nB 7\nROOT 1 2 3 0 0 0\n2\nroot 4 5 6 0 0 0\nb 8\n";
  const Motion motion = amc_motion(text, asf_with("axis 0 0 0 XYZ\ndof rz\n"));
  EXPECT_EQ(motion.clip.row(0)[6], 7);
  EXPECT_EQ(motion.clip.row(1)[6], 8);
  EXPECT_EQ(motion.clip.row(1)[2], 6);
}

TEST(AcclaimDialects, ValuesThatGoOnInTheNextLine) {
  const std::string text =
      kHeader + "1\nroot 1 2 3\n 4 5.5\n  6.0\nb\n7.0\n2\nroot 1 2 3 # a comment\n4 5 6\nb 8\n";
  const Motion motion = amc_motion(text, asf_with("axis 0 0 0 XYZ\ndof rz\n"));
  ASSERT_EQ(motion.clip.num_frames, 2u);
  EXPECT_EQ(motion.clip.row(0)[5], 6);
  EXPECT_EQ(motion.clip.row(0)[6], 7);
  EXPECT_EQ(motion.clip.row(1)[5], 6);
}

TEST(AcclaimDialects, ValuesThatAreNotFiniteAreKeptAndTold) {
  const ReadText read = read_acclaim("amc", kHeader + "1\nroot nan 0 -1.#IND 0 0 0\nb -nan(ind)\n",
                                     asf_with("axis 0 0 0 XYZ\ndof rz\n"));
  ASSERT_TRUE(read.document);
  EXPECT_EQ(read.diagnostics.count_of("AMC008", Severity::Warning), 3u);
  EXPECT_TRUE(std::isnan(read.motion().clip.row(0)[0]));
  EXPECT_TRUE(std::isnan(read.motion().clip.row(0)[2]));
}

TEST(AcclaimDialects, ADirectionIsNormalised) {
  std::string text = asf_with("axis 0 0 0 XYZ\n");
  text.replace(text.find("direction 0 1 0"), 15, "direction 1 1 0");
  const ReadText read = read_acclaim("asf", text);
  EXPECT_EQ(read.diagnostics.count_of("ASF013", Severity::Warning), 1u);
  const Vec3 end = skeleton_of(*read.document).joints[1].tips[0].offset;
  EXPECT_NEAR(end.norm(), 2, 1e-15);
}

TEST(AcclaimSkeletonOfAMotion, IsNamedByTheHeaderThenByTheFileThenTheOnlyOne) {
  const std::string good = asf_with("axis 0 0 0 XYZ\ndof rz\n");
  const std::string frame = ":DEGREES\n1\nroot 0 0 0 0 0 0\nb 5\n";
  ReadOptions options;
  options.source_name = "01_02_a.amc";
  const auto found = [&](const std::string& head, Resolver resolver) {
    options.companions = std::move(resolver);
    const ReadText read = read_acclaim("amc", head + frame, {}, options);
    return read.document ? fact_of(*read.document, "skeleton") : std::string("none");
  };
  const auto all = beside({{"take.asf", good}, {"01_02.asf", good}, {"01.asf", good}});
  EXPECT_EQ(found("#!OML:ASF H:\\a\\take.asf\n", all), "take.asf");
  EXPECT_EQ(found(":asf-file take.asf\n", all), "take.asf");
  EXPECT_EQ(found("#!OML:ASF H:\\a\\other.asf\n", all), "01_02.asf");
  EXPECT_EQ(found("", beside({{"x.asf", good}, {"01.asf", good}})), "01.asf");
  EXPECT_EQ(found("", beside({{"x.asf", good}})), "x.asf");
  EXPECT_EQ(found("", beside({{"x.asf", good}, {"y.asf", good}})), "none");
  EXPECT_EQ(found("", {}), "none");
}

TEST(AcclaimRate, IsAskedThenTheFilesThenOneHundredAndTwenty) {
  const std::string skeleton = asf_with("axis 0 0 0 XYZ\ndof rz\n");
  const std::string frame = "1\nroot 0 0 0 0 0 0\nb 5\n";
  EXPECT_EQ(frame_rate(amc_motion(kHeader + frame, skeleton).clip.timeline), 120);
  const std::string stated = kHeader + ":SAMPLES-PER-SECOND 59.94\n" + frame;
  EXPECT_EQ(frame_rate(amc_motion(stated, skeleton).clip.timeline), 59.94);
  ReadOptions options;
  options.fps = 30;
  EXPECT_EQ(frame_rate(amc_motion(stated, skeleton, options).clip.timeline), 30);
}

TEST(AcclaimUnits, LengthsAreInchesOverTheUnitUnlessAsked) {
  const std::string text = asf_with("axis 0 0 0 XYZ\n");
  EXPECT_DOUBLE_EQ(skeleton_of(*read_acclaim("asf", text).document).metres_per_unit, 0.0254 / 0.45);
  ReadOptions options;
  options.metres_per_unit = 0.01;
  const ReadText read = read_acclaim("asf", text, {}, options);
  EXPECT_DOUBLE_EQ(skeleton_of(*read.document).metres_per_unit, 0.01 / 0.45);
  EXPECT_TRUE(read.diagnostics.items().empty()) << text_of(read.diagnostics);
}

TEST(AcclaimSkeletonOfAMotion, MustBeAsf) {
  ReadOptions options;
  options.skeleton = std::make_shared<const Document>(*read_bvh(bvh_with_rows({})).document);
  options.skeleton_name = "t.bvh";
  const ReadText read =
      read_acclaim("amc", "1\nroot 0 0 0 0 0 0\n", asf_with("axis 0 0 0 XYZ\n"), options);
  EXPECT_EQ(text_of(read.diagnostics),
            "t.bvh: error[AMC003]: expected an ASF skeleton, found bvh\n");
}

/// Reads a motion on a skeleton that was read before.
ReadText read_on(const Document& skeleton, const std::string& text) {
  ReadOptions options;
  options.skeleton = std::make_shared<const Document>(skeleton);
  options.skeleton_name = "given.asf";
  return read_acclaim("amc", text, {}, options);
}

TEST(AcclaimSkeletonOfAMotion, IsTakenAsItWasBound) {
  const std::string frame = ":DEGREES\n1\nroot 1 2 3 4 5 6\nb 7 8\n";
  const std::string text = asf_with("axis 10 20 30 XYZ\ndof rz rx\nlimits (-1 1)\n(-2 2)\n",
                                    "order TX TY TZ RX RY RZ\naxis XYZ\norientation 0 15 0\n");
  const Document given = *read_acclaim("asf", text).document;
  const ReadText read = read_on(given, frame);
  ASSERT_TRUE(read.document) << text_of(read.diagnostics);
  const auto& bound = skeleton_of(given).joints;
  const auto& joints = skeleton_of(*read.document).joints;
  ASSERT_EQ(joints.size(), bound.size());
  EXPECT_EQ(joints[0].kept.get<acclaim::Root>(), bound[0].kept.get<acclaim::Root>());
  EXPECT_EQ(joints[1].kept.get<acclaim::Bone>(), bound[1].kept.get<acclaim::Bone>());
  EXPECT_NE(joints[1].kept.get<acclaim::Bone>(), nullptr);
  const ReadText beside = read_acclaim("amc", frame, text);
  EXPECT_EQ(write_to_string(*read.document, "amc"), write_to_string(*beside.document, "amc"));
  EXPECT_EQ(write_to_string(*read.document, "asf"), write_to_string(*beside.document, "asf"));
}

TEST(AcclaimSkeletonOfAMotion, MayBeForcedToThreeRotations) {
  const std::string frame = ":DEGREES\n:FORCE-ALL-JOINTS-BE-3DOF\n1\nroot 1 2 3 4 5 6\nb 7 8 9\n";
  const std::string text = asf_with("axis 10 20 30 XYZ\ndof rz\nlimits (-1 1)\n");
  const ReadText read = read_on(*read_acclaim("asf", text).document, frame);
  const ReadText beside = read_acclaim("amc", frame, text);
  ASSERT_TRUE(read.document) << text_of(read.diagnostics);
  EXPECT_EQ(read.motion().skeleton.joints[1].dofs.size(), 3u);
  EXPECT_EQ(write_to_string(*read.document, "amc"), write_to_string(*beside.document, "amc"));
  EXPECT_EQ(write_to_string(*read.document, "asf"), write_to_string(*beside.document, "asf"));
}

}  // namespace
}  // namespace kinefile::test
