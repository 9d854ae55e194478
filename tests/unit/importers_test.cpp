// SPDX-License-Identifier: MIT
// BVH that is written from other formats, imported by the rules of other programs.
#include "support/importers.hpp"

#include <gtest/gtest.h>

#include "formats/acclaim/arm.hpp"
#include "kinefile/bvh.hpp"
#include "kinefile/convert.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/io.hpp"
#include "kinefile/kinematics.hpp"
#include "support/random_skeletons.hpp"
#include "support/robots.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile::test {
namespace {

constexpr Importer kAll[] = {Importer::Blender, Importer::Three, Importer::Assimp};
constexpr double kSamePlaceAsImported = 1e-9;  // of the motion's size

/// What `convert` writes of a document as BVH; empty if it is refused.
std::string converted_to_bvh(Document document, const KindOptions& kinds = {.keeps_up = true},
                             const shape::ChannelOptions& channels = {.lenient = true}) {
  const Format& format = *find_format("bvh");
  Diagnostics diagnostics;
  auto made = in_kind_of(format, std::move(document), kinds, diagnostics);
  if (made) made = adapted_to(format, std::move(*made), channels, diagnostics);
  return made ? write_to_string(*made) : "";
}

/// Expects that a program imports a text, with every joint at its place in a motion.
void expect_imported(const std::string& text, const Motion& motion, Importer importer,
                     const std::string& what) {
  const Import import = import_bvh(text, importer);
  ASSERT_EQ(import.refusal, "") << what;
  ASSERT_EQ(import.positions.size(), motion.clip.num_frames) << what;
  const WorldPoses poses = forward_kinematics(motion.skeleton, motion.clip);
  const double limit = kSamePlaceAsImported * world_size(motion);
  for (std::size_t i = 0; i < import.names.size(); ++i) {
    const auto& joints = motion.skeleton.joints;
    const auto joint = std::find_if(joints.begin(), joints.end(), [&](const Joint& candidate) {
      return candidate.name == import.names[i];
    });
    ASSERT_NE(joint, joints.end()) << what << ": " << import.names[i];
    const auto j = static_cast<std::size_t>(joint - joints.begin());
    for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
      const Vec3 expected(poses.positions.data() + (f * joints.size() + j) * 3);
      const double distance = (import.positions[f][i] - expected).norm();
      ASSERT_LE(distance, limit) << what << ": " << import.names[i] << " in frame " << f;
    }
  }
}

/// Expects that every program imports a text: Blender and assimp with every joint at its place in a
/// motion, three.js, which adds positions to OFFSET, as a reader that does so.
void expect_imported_by_all(const std::string& text, const Motion& motion,
                            const std::string& what) {
  expect_imported(text, motion, Importer::Blender, what + " in Blender");
  expect_imported(text, motion, Importer::Assimp, what + " in assimp");
  ReadOptions added;
  added.of_formats = bvh::ReadOptions{bvh::PositionMode::Add};
  expect_imported(text, read_bvh(text, added).motion(), Importer::Three, what + " in three.js");
}

std::string with_channels_of_joint(const std::string& channels, const std::string& row) {
  return "HIERARCHY\nROOT r\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation "
         "Xrotation Yrotation\nJOINT a\n{\nOFFSET 1 2 3\nCHANNELS " +
         channels +
         "\nEnd Site\n{\nOFFSET 1 0 0\n}\n}\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n0 0 0 0 0 0 " +
         row + "\n";
}

TEST(Importers, BlenderRefusesTwoRotationsAndRepeatedAxes) {
  const auto refusal = [](const std::string& channels, const std::string& row) {
    return import_bvh(with_channels_of_joint(channels, row), Importer::Blender).refusal;
  };
  EXPECT_EQ(refusal("2 Zrotation Yrotation", "1 2"), "KeyError: (2, 1, None)");
  EXPECT_EQ(refusal("1 Xrotation", "1"), "KeyError: (0, None, None)");
  EXPECT_EQ(refusal("3 Zrotation Xrotation Zrotation", "1 2 3"), "KeyError: (2, 0, 2)");
  EXPECT_EQ(refusal("3 Zrotation Xrotation Yrotation", "1 2 3"), "");
  EXPECT_EQ(refusal("0", ""), "");
  for (const Importer importer : {Importer::Three, Importer::Assimp}) {
    const std::string text = with_channels_of_joint("2 Zrotation Yrotation", "1 2");
    EXPECT_EQ(import_bvh(text, importer).refusal, "");
  }
}

TEST(Importers, PlaceAJointWithOnePositionDifferently) {
  const std::string text = with_channels_of_joint("1 Yposition", "5");
  EXPECT_EQ(import_bvh(text, Importer::Blender).positions[0][1], Vec3(0, 5, 0));
  EXPECT_EQ(import_bvh(text, Importer::Three).positions[0][1], Vec3(1, 7, 3));
  EXPECT_EQ(import_bvh(text, Importer::Assimp).positions[0][1], Vec3(1, 2, 3));
  const std::string whole = converted_to_bvh({motion_of(text), "json", {}});
  EXPECT_EQ(import_bvh(whole, Importer::Blender).positions[0][1], Vec3(1, 5, 3));
  EXPECT_EQ(import_bvh(whole, Importer::Assimp).positions[0][1], Vec3(1, 5, 3));
}

TEST(Importers, RefuseWhatTheyDoNotKnow) {
  const std::string scaled = with_channels_of_joint("1 Xscale", "2");
  EXPECT_EQ(import_bvh(scaled, Importer::Blender).refusal, "");
  EXPECT_EQ(import_bvh(scaled, Importer::Three).refusal, "an unknown channel");
  const std::string six = with_channels_of_joint(
      "6 Xrotation Yrotation Zrotation Xrotation Yrotation Zrotation", "0 0 0 0 0 0");
  EXPECT_EQ(import_bvh(six, Importer::Blender).refusal,
            "IndexError: list assignment index out of range");
  EXPECT_EQ(import_bvh(six, Importer::Assimp).refusal, "Missing position channel");
  const std::string twice = replaced(with_channels_of_joint("0", ""), "JOINT a", "JOINT r");
  EXPECT_EQ(import_bvh(twice, Importer::Blender).refusal, "two nodes of one name");
  const std::string blank = replaced(twice, "JOINT r", "JOINT r 2");
  EXPECT_EQ(import_bvh(blank, Importer::Blender).names[1], "r_2");
  EXPECT_EQ(import_bvh(blank, Importer::Three).refusal, "a name of several words");
  const std::string forest =
      replaced(twice, "MOTION", "ROOT s\n{\nOFFSET 0 0 0\nCHANNELS 0\n}\nMOTION");
  EXPECT_EQ(import_bvh(forest, Importer::Assimp).refusal, "expected MOTION, found ROOT");
  const std::string end = replaced(twice, "End Site", "End Site tip");
  EXPECT_EQ(import_bvh(end, Importer::Three).refusal, "");
  EXPECT_EQ(import_bvh(end, Importer::Assimp).refusal, "a name after End Site");
  const std::string lost = replaced(twice, "Frames: 1", "Frames: 2");
  for (const Importer importer : kAll) {
    EXPECT_EQ(import_bvh(lost, importer).refusal, "Frames: is wrong");
  }
}

TEST(Importers, TakeAnArmOfAcclaim) {
  for (const std::string name : {"arm", "turned"}) {
    const ReadText amc = read_acclaim("amc", fixture("acclaim/valid/" + name + ".amc"),
                                      fixture("acclaim/valid/" + name + ".asf"));
    ASSERT_TRUE(amc.document) << text_of(amc.diagnostics);
    expect_imported_by_all(converted_to_bvh(*amc.document), amc.motion(), name);
  }
  const ReadText amc =
      read_acclaim("amc", fixture("acclaim/valid/arm.amc"), fixture("acclaim/valid/arm.asf"));
  const std::string as_is = converted_to_bvh(*amc.document, {.keeps_up = true},
                                             {.positions = shape::PositionChannels::AsIs});
  EXPECT_EQ(import_bvh(as_is, Importer::Blender).refusal, "KeyError: (2, None, None)");
}

TEST(Importers, TakeBonesThatWereMadeOfAWalk) {
  const Document walk{examples::make_walk({.num_frames = 20}), "bvh", {}};
  Diagnostics diagnostics;
  const auto amc = adapted_to(*find_format("amc"), walk, {}, diagnostics);
  ASSERT_TRUE(amc);
  Document bones = *amc;
  bones.format = "amc";
  expect_imported_by_all(converted_to_bvh(bones), std::get<Motion>(walk.content), "a walk");
}

TEST(Importers, TakeARobotWithItsMotion) {
  const BodyMotion body = hinge_motion({0, 0.5, -0.25});
  const Document robot{hinge_robot(), "urdf", {}};
  Diagnostics diagnostics;
  const auto posed = robot::pose(body, hinge_robot(), false, diagnostics);
  ASSERT_TRUE(posed);
  expect_imported_by_all(
      converted_to_bvh({body, "choreonoid", {}}, {.model = &robot, .keeps_up = true}), *posed,
      "a hinge");
  expect_imported_by_all(converted_to_bvh({*posed, "csv", {}}), *posed, "a table of a robot");
}

TEST(Importers, TakeARobotOfEveryFormatWithItsMotion) {
  const std::string examples = "../../examples/";
  const ReadOptions named{.source_name = "little"};
  Diagnostics diagnostics;
  const auto seq =
      find_format("choreonoid")->read(fixture(examples + "bow.seq"), named, diagnostics);
  ASSERT_TRUE(seq) << text_of(diagnostics);
  for (const std::string format : {"body", "urdf"}) {
    const auto robot =
        find_format(format)->read(fixture(examples + "robot." + format), named, diagnostics);
    ASSERT_TRUE(robot) << text_of(diagnostics);
    auto posed =
        robot::pose(std::get<BodyMotion>(seq->content), skeleton_of(*robot), true, diagnostics);
    ASSERT_TRUE(posed);
    const std::string text = converted_to_bvh(*seq, {.model = &*robot, .keeps_up = true});
    expect_imported_by_all(text, *posed, format);
    const std::string still = converted_to_bvh(*robot) + "MOTION\nFrames: 0\nFrame Time: 1\n";
    for (const Importer importer : kAll) {
      EXPECT_EQ(import_bvh(still, importer).names.size(), 19u) << "the model alone";
    }
  }
}

/// Joints as no format of files has them: without rotations, with four, about oblique axes, with
/// two slides along one axis, with gains, balls and shared columns.
Motion odd_motion() {
  Motion motion;
  motion.skeleton.angle_unit = AngleUnit::Degrees;
  const auto add = [&motion](const char* name, std::vector<DegreeOfFreedom> dofs) {
    Joint joint;
    joint.name = name;
    joint.offset = Vec3(0.5, 1, -0.25);
    const std::size_t j = motion.skeleton.joints.size();
    if (j > 0) joint.parent = j - 1;
    for (DegreeOfFreedom& dof : dofs) {
      dof.coordinate = motion.skeleton.coordinates.size();
      for (std::size_t k = 0; k < num_coordinates(dof); ++k) {
        motion.skeleton.coordinates.push_back({j, "value"});
      }
      joint.dofs.push_back(dof);
    }
    motion.skeleton.joints.push_back(joint);
  };
  const auto turn = [](const Vec3& axis) {
    return DegreeOfFreedom{DofKind::Rotation, axis.normalized(), 0, 0};
  };
  const auto slide = [](const Vec3& axis) {
    return DegreeOfFreedom{DofKind::Translation, axis.normalized(), 0, 0};
  };
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  add("fixed_root", {});
  add("four", {turn(x), turn(y), turn(z), turn(x)});
  add("twice", {turn(y), turn(y)});
  add("proper", {turn(z), turn(x), turn(z)});
  add("oblique", {turn(x + y), turn(-z)});
  add("slides", {slide(y), slide(y), turn(x)});
  add("backwards", {slide(-x), slide(y + z)});
  add("ball", {{DofKind::RotationVector, x, 0, 0}});
  motion.skeleton.joints[2].dofs[0].gain = -2;
  motion.skeleton.joints[2].dofs[0].shift = 30;
  motion.skeleton.joints[4].dofs[1].coordinate = motion.skeleton.joints[1].dofs[0].coordinate;
  motion.clip.num_frames = 6;
  motion.clip.num_coordinates = motion.skeleton.coordinates.size();
  motion.clip.timeline = {FrameTime{0.1}, 0};
  for (std::size_t i = 0; i < 6 * motion.clip.num_coordinates; ++i) {
    motion.clip.values.push_back(static_cast<double>(i * 37 % 101) - 50);
  }
  return motion;
}

TEST(Importers, TakeJointsThatNoFormatHas) {
  const Motion odd = odd_motion();
  ASSERT_TRUE(validate(odd));
  expect_imported_by_all(converted_to_bvh({odd, "json", {}}), odd, "odd joints");
}

/// The first frames of a long motion.
Motion beginning(const Motion& motion) {
  const auto part = edit::trim(motion, 0, 60);
  return part ? *part : Motion{};
}

TEST(Importers, TakeMotionsOfRealFiles) {
  SKIP_WITHOUT_DATA();
  const std::string folder = data_folder() + "/";
  Diagnostics diagnostics;
  const auto amc = read_file(folder + "acclaim/cmu/02_01.amc", nullptr, {}, diagnostics);
  ASSERT_TRUE(amc) << text_of(diagnostics);
  const Motion walk = beginning(std::get<Motion>(amc->content));
  expect_imported_by_all(converted_to_bvh({walk, "amc", {}}), walk, "02_01.amc");
  const std::string choreonoid = folder + "choreonoid/";
  const auto seq = read_file(choreonoid + "motion/SR1WalkPattern1.seq", nullptr, {}, diagnostics);
  ASSERT_TRUE(seq) << text_of(diagnostics);
  for (const std::string name : {"SR1.body", "SR1.urdf"}) {
    const auto robot = read_file(choreonoid + "model/" + name, nullptr, {}, diagnostics);
    ASSERT_TRUE(robot) << text_of(diagnostics);
    const auto posed =
        robot::pose(std::get<BodyMotion>(seq->content), skeleton_of(*robot), true, diagnostics);
    ASSERT_TRUE(posed);
    const Motion steps = beginning(*posed);
    expect_imported_by_all(converted_to_bvh({steps, "choreonoid", {}}), steps, name);
  }
}

TEST(Importers, TakeRandomSkeletons) {
  RandomSource random(77);
  std::size_t num_taken = 0;
  for (int i = 0; i < 200; ++i) {
    Motion motion = random_motion(
        random, {.free_joints = i % 3 == 0, .tail_scales = false, .several_roots = i % 2 == 0});
    for (Joint& joint : motion.skeleton.joints) {
      for (Tip& tip : joint.tips) tip.name.clear();  // assimp takes no names of End Sites
    }
    const std::string text = converted_to_bvh({motion, "json", {}});
    if (text.empty()) continue;
    ++num_taken;
    const std::string what = "skeleton " + std::to_string(i);
    if (i % 2 == 0) {
      expect_imported(text, motion, Importer::Blender, what);
    } else {
      expect_imported_by_all(text, motion, what);
    }
  }
  EXPECT_GT(num_taken, 120u);
}

TEST(Importers, TakeRandomBonesAndRobots) {
  RandomSource random(78);
  for (int i = 0; i < 60; ++i) {
    const Motion bones = random_bones(random);
    expect_imported_by_all(converted_to_bvh({bones, "amc", {}}), bones, "bones");
    const Motion robot = random_robot(random);
    expect_imported_by_all(converted_to_bvh({robot, "csv", {}}), robot, "a robot");
  }
}

}  // namespace
}  // namespace kinefile::test
