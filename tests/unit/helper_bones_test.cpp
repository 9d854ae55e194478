// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "kinefile/convert.hpp"
#include "kinefile/shape.hpp"
#include "support/random_skeletons.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

Joint plain_joint(const std::string& name, std::size_t parent, const Vec3& offset,
                  std::vector<Tip> tips = {}) {
  Joint joint;
  joint.name = name;
  joint.parent = parent;
  joint.offset = offset;
  joint.tips = std::move(tips);
  return joint;
}

/// Lets a joint turn about x, by a column of its own.
void let_turn(Skeleton& skeleton, std::size_t joint) {
  skeleton.joints[joint].dofs.push_back(
      {DofKind::Rotation, Vec3::UnitX(), skeleton.coordinates.size(), 0});
  skeleton.coordinates.push_back({joint, "rx"});
}

Motion still(Skeleton skeleton) {
  Motion motion{std::move(skeleton), {}};
  motion.clip.num_coordinates = motion.skeleton.coordinates.size();
  return motion;
}

std::vector<std::string> names_of(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const Joint& joint : skeleton.joints) names.push_back(joint.name);
  return names;
}

TEST(HelperBones, AreTakenOutAndTheirOffsetsAdded) {
  Skeleton skeleton;
  skeleton.joints = {plain_joint("root", kNoParent, Vec3(5, 6, 7)),
                     plain_joint("a_root_kf_helper", 0, Vec3(1, 0, 0), {{"", Vec3(0, 2, 0)}}),
                     plain_joint("b_kf_helper", 1, Vec3(0, 2, 0), {{"", Vec3(0, 0, 4)}}),
                     plain_joint("b", 2, Vec3(0, -0.0, 4), {{"", Vec3(1, 1, 1)}}),
                     plain_joint("b_end_kf_helper", 3, Vec3(1, 1, 1), {{"", Vec3(1, 0, 0)}}),
                     plain_joint("Toe_kf_helper", 3, Vec3(1, 1, 1), {{"", Vec3(2, 0, 0)}})};
  let_turn(skeleton, 0);
  let_turn(skeleton, 3);
  Diagnostics diagnostics;
  const Skeleton bare = shape::without_helper_bones(still(skeleton), diagnostics).skeleton;
  EXPECT_EQ(names_of(bare), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(bare.joints[0].offset, Vec3(5, 6, 7));
  EXPECT_TRUE(bare.joints[0].tips.empty()) << "helpers led to where its tips would be";
  EXPECT_EQ(bare.joints[1].parent, 0u);
  EXPECT_EQ(bare.joints[1].offset, Vec3(1, 2, 4));
  ASSERT_EQ(bare.joints[1].tips.size(), 3u);
  EXPECT_EQ(bare.joints[1].tips[0].offset, Vec3(1, 1, 1));
  EXPECT_EQ(bare.joints[1].tips[1].offset, Vec3(2, 1, 1));
  EXPECT_EQ(bare.joints[1].tips[1].name, "");
  EXPECT_EQ(bare.joints[1].tips[2].name, "Toe");
  EXPECT_EQ(bare.coordinates[1].joint, 1u);
  EXPECT_TRUE(validate(bare));
  EXPECT_EQ(codes_of(diagnostics), std::vector<std::string>{"BRG005"});
}

TEST(HelperBones, StayWhereOneOfTheThreeSignsIsMissing) {
  Skeleton skeleton;
  skeleton.joints = {plain_joint("hips_kf_helper", kNoParent, Vec3(0, 0, 0)),
                     plain_joint("turns_kf_helper", 0, Vec3(1, 0, 0)),
                     plain_joint("tilted_kf_helper", 0, Vec3(2, 0, 0)),
                     plain_joint("lhipjoint", 0, Vec3(3, 0, 0)),
                     plain_joint("column_kf_helper", 0, Vec3(4, 0, 0)),
                     plain_joint("_kf_helper", 0, Vec3(5, 0, 0))};
  skeleton.joints[2].rest_rotation = Quat(Eigen::AngleAxisd(0.1, Vec3::UnitZ()));
  let_turn(skeleton, 1);
  skeleton.coordinates.push_back({4, "unknown"});
  Diagnostics diagnostics;
  const Motion bare = shape::without_helper_bones(still(skeleton), diagnostics);
  EXPECT_TRUE(same_skeleton(bare.skeleton, skeleton));
  EXPECT_TRUE(diagnostics.items().empty());
}

TEST(HelperBones, GiveTheRootNoNameThatAJointHas) {
  Skeleton skeleton;
  skeleton.joints = {plain_joint("root", kNoParent, Vec3(0, 0, 0)),
                     plain_joint("a_root_kf_helper", 0, Vec3(0, 0, 0), {{"", Vec3(0, 1, 0)}}),
                     plain_joint("a_root", 1, Vec3(0, 1, 0), {{"", Vec3(0, 1, 0)}})};
  Diagnostics diagnostics;
  const Skeleton bare = shape::without_helper_bones(still(skeleton), diagnostics).skeleton;
  EXPECT_EQ(names_of(bare), (std::vector<std::string>{"root", "a_root"}));
}

TEST(HelperBones, HaveNamesThatNoJointHas) {
  // The third joint, which can turn, has the name that the helper to the second one would get.
  Skeleton skeleton;
  skeleton.joints = {plain_joint("root", kNoParent, Vec3(0, 0, 0)),
                     plain_joint("a", 0, Vec3(0, 1, 0), {{"", Vec3(0, 1, 0)}}),
                     plain_joint("A_KF_helper", 0, Vec3(1, 0, 0), {{"", Vec3(0, 1, 0)}})};
  let_turn(skeleton, 2);
  Diagnostics diagnostics;
  const auto bones = shape::with_bones(still(skeleton), false, diagnostics);
  ASSERT_TRUE(bones);
  EXPECT_EQ(names_of(bones->skeleton),
            (std::vector<std::string>{"root", "a_2_kf_helper", "a", "A_KF_helper_kf_helper",
                                      "A_KF_helper"}));
  const Motion back = shape::without_helper_bones(*bones, diagnostics);
  EXPECT_EQ(names_of(back.skeleton), names_of(skeleton));
}

constexpr const char* kForkedText =
    "HIERARCHY\nROOT Hips\n{\nOFFSET 0 9 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation "
    "Xrotation Yrotation\n"
    "JOINT L\n{\nOFFSET 3 -4 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\nOFFSET 0 -4 "
    "0\n}\nEnd Site\n{\nOFFSET 0 -4 2\n}\n}\n"
    "JOINT R\n{\nOFFSET -3 -4 0\nCHANNELS 1 Xrotation\nEnd Site\n{\nOFFSET 0 -4 0\n}\n}\n}\n";

/// Writes a document as a format after what `convert` does, and reads it.
Document through(Document document, const std::string& name, Diagnostics& diagnostics,
                 const shape::ChannelOptions& channels = {}) {
  const Format& format = *find_format(name);
  auto made = in_kind_of(format, std::move(document), {}, diagnostics);
  if (made) made = adapted_to(format, std::move(*made), channels, diagnostics);
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
  const std::string text = write_to_string(*made, name);
  auto read = format.read(text, {}, diagnostics);
  EXPECT_TRUE(read) << text_of(diagnostics);
  return read ? *read : Document{};
}

TEST(HelperBones, ASkeletonComesBackThroughAsf) {
  const ReadText first = read_bvh(kForkedText);
  ASSERT_TRUE(first.document);
  Diagnostics diagnostics;
  const Document asf = through(*first.document, "asf", diagnostics);
  EXPECT_EQ(skeleton_of(asf).joints.size(), 7u);
  EXPECT_EQ(skeleton_of(asf).joints[1].name, "Hips_root_kf_helper");
  const std::string text = write_to_string(*first.document, "bvh");
  const shape::ChannelOptions as_is{.positions = shape::PositionChannels::AsIs};
  EXPECT_EQ(write_to_string(through(asf, "bvh", diagnostics, as_is), "bvh"), text);
  const std::string whole =
      replaced(text, "CHANNELS 1 Xrotation", "CHANNELS 3 Zrotation Yrotation Xrotation");
  EXPECT_EQ(write_to_string(through(asf, "bvh", diagnostics), "bvh"), whole);
}

TEST(HelperBones, ASkeletonIsWrittenWithoutThemAsJson) {
  Diagnostics diagnostics;
  const Document asf = through(*read_bvh(kForkedText).document, "asf", diagnostics);
  const auto json = in_kind_of(*find_format("json"), asf, {}, diagnostics);
  ASSERT_TRUE(json);
  EXPECT_EQ(names_of(skeleton_of(*json)), (std::vector<std::string>{"Hips", "L", "R"}));
}

}  // namespace
}  // namespace kinefile::test
