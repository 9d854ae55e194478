// SPDX-License-Identifier: MIT
#include "kinefile/skeleton.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace kinefile {
namespace {

/// Two joints: a free root, and a hinge about y on it.
Skeleton small_robot() {
  Skeleton skeleton;
  Joint root;
  root.name = "base";
  root.dofs = {{DofKind::Free, Vec3::UnitX(), 0, 0}};
  Joint hinge;
  hinge.name = "hinge";
  hinge.parent = 0;
  hinge.offset = {0, 0, 1};
  hinge.dofs = {{DofKind::Rotation, Vec3::UnitY(), 7, 0.5}};
  hinge.tips = {{"", {1, 0, 0}}, {"palm", {2, 0, 0}}};
  skeleton.joints = {root, hinge};
  for (const char* channel : {"x", "y", "z", "qw", "qx", "qy", "qz"}) {
    skeleton.coordinates.push_back({0, channel});
  }
  skeleton.coordinates.push_back({1, "q"});
  return skeleton;
}

std::string fault_of(const Skeleton& skeleton) {
  const auto result = validate(skeleton);
  return result ? "" : result.error().message;
}

TEST(Skeleton, ARobotIsValid) { EXPECT_EQ(fault_of(small_robot()), ""); }

TEST(Skeleton, ParentsComeFirst) {
  Skeleton skeleton = small_robot();
  skeleton.joints[0].parent = 1;
  EXPECT_EQ(fault_of(skeleton), "joint 'base' comes before its parent");
  skeleton.joints[0].parent = 0;
  EXPECT_EQ(fault_of(skeleton), "joint 'base' comes before its parent");
}

TEST(Skeleton, CoordinatesExist) {
  Skeleton skeleton = small_robot();
  skeleton.joints[1].dofs[0].coordinate = 8;
  EXPECT_EQ(fault_of(skeleton), "joint 'hinge' reads coordinate 8 of 8");
  skeleton = small_robot();
  skeleton.joints[0].dofs[0].coordinate = 2;
  EXPECT_EQ(fault_of(skeleton), "joint 'base' reads coordinate 2 of 8");
  skeleton = small_robot();
  skeleton.coordinates[3].joint = 2;
  EXPECT_EQ(fault_of(skeleton), "coordinate 3 belongs to no joint");
}

TEST(Skeleton, AxesHaveUnitLength) {
  Skeleton skeleton = small_robot();
  skeleton.joints[1].dofs[0].axis = {0, 1, 1e-3};
  EXPECT_EQ(fault_of(skeleton), "joint 'hinge' has an axis that is not of unit length");
  skeleton.joints[1].dofs[0].axis = {0, NAN, 0};
  EXPECT_EQ(fault_of(skeleton), "joint 'hinge' has an axis that is not of unit length");
}

TEST(Skeleton, NumbersAreFinite) {
  Skeleton skeleton = small_robot();
  skeleton.joints[1].offset[1] = INFINITY;
  EXPECT_EQ(fault_of(skeleton), "joint 'hinge' has an offset that is not finite");
  skeleton = small_robot();
  skeleton.joints[1].tips[1].offset[1] = NAN;
  EXPECT_EQ(fault_of(skeleton), "joint 'hinge' has a tip that is not finite");
  skeleton = small_robot();
  skeleton.joints[1].visuals = {{ShapeKind::Box, {1, 0, 2}, {1, 2, 3}}};
  EXPECT_EQ(fault_of(skeleton), "");
  skeleton.joints[1].visuals[0].size = {1, -1, 2};
  EXPECT_EQ(fault_of(skeleton), "joint 'hinge' has a shape with numbers that it cannot have");
  skeleton.joints[1].visuals[0].size = {1, 1, 2};
  skeleton.joints[1].visuals[0].colour = Vec3(0, 0, 1.5);
  EXPECT_EQ(fault_of(skeleton), "joint 'hinge' has a shape with numbers that it cannot have");
  skeleton = small_robot();
  skeleton.joints[1].dofs[0].rest = NAN;
  EXPECT_EQ(fault_of(skeleton), "joint 'hinge' has a rest value that is not finite");
  skeleton = small_robot();
  skeleton.joints[1].rest_rotation = Quat(2, 0, 0, 0);
  EXPECT_EQ(fault_of(skeleton), "joint 'hinge' has a rest rotation that is not of unit length");
}

TEST(Skeleton, TranslationsPrecedeRotations) {
  Skeleton skeleton = small_robot();
  skeleton.joints[1].dofs.push_back({DofKind::Translation, Vec3::UnitX(), 7, 0});
  EXPECT_EQ(fault_of(skeleton), "joint 'hinge' translates after it rotates");
}

TEST(Skeleton, AFreeJointMovesInNoOtherWay) {
  Skeleton skeleton = small_robot();
  skeleton.joints[0].dofs.push_back({DofKind::Rotation, Vec3::UnitX(), 7, 0});
  EXPECT_EQ(fault_of(skeleton), "joint 'base' is free and moves in another way, too");
}

TEST(Skeleton, AJointThatTurnsInAnyWayTurnsInNoOtherWay) {
  for (const DofKind kind : {DofKind::Ball, DofKind::RotationVector}) {
    Skeleton skeleton = small_robot();
    skeleton.joints[0].dofs = {{kind, Vec3::UnitX(), 0, 0}};
    EXPECT_EQ(fault_of(skeleton), "");
    EXPECT_EQ(num_dofs(skeleton.joints[0]), 3u);
    skeleton.joints[0].dofs.push_back({DofKind::Rotation, Vec3::UnitX(), 5, 0});
    EXPECT_EQ(fault_of(skeleton), "joint 'base' turns in any way and in another way, too");
    skeleton.joints[0].dofs = {{kind, Vec3::UnitX(), 6, 0}};
    EXPECT_EQ(fault_of(skeleton), "joint 'base' reads coordinate 6 of 8");
    skeleton.joints[0].dofs = {{kind, Vec3::UnitX(), 0, 0}};
    skeleton.joints[0].dofs[0].gain = 2;
    EXPECT_EQ(fault_of(skeleton), "joint 'base' has a gain or a shift of several columns");
  }
}

TEST(Skeleton, GainsAreFiniteAndReadersOfAColumnRestAlike) {
  Skeleton skeleton = small_robot();
  skeleton.joints[1].dofs[0].gain = std::nan("");
  EXPECT_EQ(fault_of(skeleton), "joint 'hinge' has a gain or a shift that is not finite");
  skeleton = small_robot();
  Joint mimic = skeleton.joints[1];
  mimic.name = "mimic";
  mimic.dofs[0].gain = -2;
  mimic.dofs[0].shift = 1;
  skeleton.joints.push_back(mimic);
  EXPECT_EQ(fault_of(skeleton), "");
  skeleton.joints[2].dofs[0].rest = 0.25;
  EXPECT_EQ(fault_of(skeleton),
            "joint 'hinge' rests at 0.5 in column 7, another one of its readers at 0.25");
}

TEST(Skeleton, ValuesAreMadeOfColumnsAndBack) {
  DegreeOfFreedom dof;
  EXPECT_TRUE(std::signbit(value_of(dof, -0.0)));
  EXPECT_TRUE(std::signbit(column_of(dof, -0.0)));
  dof.gain = -4;
  dof.shift = 1;
  EXPECT_EQ(value_of(dof, 2), -7);
  EXPECT_EQ(column_of(dof, -7), 2);
  dof.gain = 0;
  dof.rest = 3;
  EXPECT_EQ(value_of(dof, 2), 1);
  EXPECT_EQ(column_of(dof, 7), 3);
}

TEST(Skeleton, TheJointThatAColumnBelongsToLeadsIt) {
  Skeleton skeleton = small_robot();
  Joint mimic = skeleton.joints[1];
  mimic.name = "mimic";
  skeleton.joints.push_back(mimic);
  skeleton.coordinates[7].joint = 2;
  EXPECT_EQ(leaders_of_columns(skeleton), (std::vector<std::size_t>{0, 0, 0, 0, 0, 0, 0, 2}));
  skeleton.coordinates[7].joint = 0;  // which does not read it
  EXPECT_EQ(leaders_of_columns(skeleton)[7], 1u);
  skeleton.coordinates.push_back({1, "unread"});
  EXPECT_EQ(leaders_of_columns(skeleton)[8], kNoParent);
}

TEST(Skeleton, RestCoordinates) {
  EXPECT_EQ(rest_coordinates(small_robot()), (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 0.5}));
}

TEST(Skeleton, RestOffsetHoldsTheRestOfTranslations) {
  Joint joint;
  joint.offset = {1, 0, 0};
  joint.rest_rotation = Quat(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ()));
  joint.dofs = {{DofKind::Translation, Vec3::UnitX(), 0, 5}};
  EXPECT_LT((rest_offset(joint) - Vec3(1, 5, 0)).norm(), 1e-15);
}

TEST(Skeleton, CountsAndNames) {
  const Skeleton skeleton = small_robot();
  EXPECT_EQ(num_dofs(skeleton), 7u);
  EXPECT_EQ(num_tips(skeleton), 2u);
  EXPECT_EQ(tip_label(skeleton.joints[1], 0), "hinge.tip");
  EXPECT_EQ(tip_label(skeleton.joints[1], 1), "hinge.tip2");
  EXPECT_EQ(column_names(skeleton)[3], "base.qw");
  EXPECT_EQ(column_names(skeleton)[7], "hinge.q");
  EXPECT_EQ(children_of_joints(skeleton)[0], std::vector<std::size_t>{1});
  EXPECT_EQ(channel_name(DofKind::Rotation, 2), "Zrotation");
  EXPECT_EQ(channel_name(DofKind::TailScale, 0), "Xscale");
}

TEST(IsBoneName, IsOneWordThatIsNoNumberAndNoKeyword) {
  for (const char* name : {"lfemur", "2upper", "Hips", "mixamorig:Hips", "end_1", "infant", "x"}) {
    EXPECT_TRUE(is_bone_name(name)) << name;
  }
  for (const char* name : {"", "a b", "a(b", "a,b", "a#b", ":a", "12", "-1e5", "Root", "END",
                           "begin", "inf", "-nan", "+Infinity", "a\tb"}) {
    EXPECT_FALSE(is_bone_name(name)) << name;
  }
}

TEST(NumReadersOfColumns, CountsSharedColumnsAndAllSevenOfAFreeJoint) {
  Skeleton skeleton;
  skeleton.coordinates.resize(9, {0, "q"});
  skeleton.joints.resize(2);
  skeleton.joints[0].dofs = {{DofKind::Free, Vec3::UnitX(), 0, 0}};
  skeleton.joints[1].dofs = {{DofKind::Rotation, Vec3::UnitX(), 7, 0},
                             {DofKind::Rotation, Vec3::UnitY(), 7, 0}};
  EXPECT_EQ(num_readers_of_columns(skeleton),
            (std::vector<std::size_t>{1, 1, 1, 1, 1, 1, 1, 2, 0}));
}

}  // namespace
}  // namespace kinefile
