// SPDX-License-Identifier: MIT
#include "kinefile/kinematics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace kinefile {
namespace {

Mat3 about(const Vec3& axis, double radians) {
  return Eigen::AngleAxisd(radians, axis).toRotationMatrix();
}

Joint joint_at(std::string name, std::size_t parent, const Vec3& offset) {
  Joint joint;
  joint.name = std::move(name);
  joint.parent = parent;
  joint.offset = offset;
  return joint;
}

/// Gives the last joint a movement that reads a new column.
void add_dof(Skeleton& skeleton, DofKind kind, const Vec3& axis, double rest = 0) {
  skeleton.joints.back().dofs.push_back({kind, axis, skeleton.coordinates.size(), rest});
  const std::size_t count = kind == DofKind::Free ? 7 : 1;
  for (std::size_t i = 0; i < count; ++i) {
    skeleton.coordinates.push_back({skeleton.joints.size() - 1, "q"});
  }
}

Clip clip_of(const Skeleton& skeleton, std::vector<double> values) {
  EXPECT_TRUE(validate(skeleton));
  Clip clip;
  clip.num_coordinates = skeleton.coordinates.size();
  clip.num_frames = clip.num_coordinates > 0 ? values.size() / clip.num_coordinates : 1;
  clip.values = std::move(values);
  return clip;
}

Vec3 position_of(const PoseArrays& poses, std::size_t frame, std::size_t joint) {
  const double* p = &poses.positions[(frame * poses.num_joints + joint) * 3];
  return {p[0], p[1], p[2]};
}

Vec3 tip_of(const PoseArrays& poses, std::size_t frame, std::size_t tip) {
  const double* p = &poses.tips[(frame * poses.num_tips + tip) * 3];
  return {p[0], p[1], p[2]};
}

Mat3 rotation_of(const PoseArrays& poses, std::size_t frame, std::size_t joint) {
  const double* q = &poses.rotations[(frame * poses.num_joints + joint) * 4];
  return Quat(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

void expect_near(const Vec3& found, const Vec3& expected) {
  EXPECT_LT((found - expected).norm(), 1e-14 * (1 + expected.norm())) << found.transpose();
}

constexpr KinematicsOptions kAll = {.rotations = true, .directions = true, .tips = true};

TEST(ForwardKinematics, AsfBoneTurnsAboutItsOwnAxes) {
  // An Acclaim bone turns by C M C^-1, C = Rz(c) Ry(b) Rx(a) from its axis line, M = Rz Ry Rx of
  // its values (dof rx ry rz). As degrees of freedom: rotations about C z, C y, C x.
  const Vec3 axis_angles(0.4, -1.1, 0.7);
  const Mat3 c = about(Vec3::UnitZ(), axis_angles[2]) * about(Vec3::UnitY(), axis_angles[1]) *
                 about(Vec3::UnitX(), axis_angles[0]);
  Skeleton skeleton;
  skeleton.angle_unit = AngleUnit::Radians;
  skeleton.joints.push_back(joint_at("root", kNoParent, {0, 0, 0}));
  skeleton.joints.push_back(joint_at("bone", 0, {1, 2, 3}));
  skeleton.joints.back().tips = {{"", {0, -5, 1}}};
  for (const char* channel : {"rx", "ry", "rz"}) skeleton.coordinates.push_back({1, channel});
  skeleton.joints.back().dofs = {{DofKind::Rotation, c * Vec3::UnitZ(), 2, 0},
                                 {DofKind::Rotation, c * Vec3::UnitY(), 1, 0},
                                 {DofKind::Rotation, c * Vec3::UnitX(), 0, 0}};
  const Vec3 values(0.3, 1.9, -2.2);
  const Clip clip = clip_of(skeleton, {values[0], values[1], values[2]});
  const WorldPoses poses = forward_kinematics(skeleton, clip, kAll);

  const Mat3 m = about(Vec3::UnitZ(), values[2]) * about(Vec3::UnitY(), values[1]) *
                 about(Vec3::UnitX(), values[0]);
  const Mat3 expected = c * m * c.transpose();
  EXPECT_LT((rotation_of(poses, 0, 1) - expected).norm(), 1e-14);
  EXPECT_LT((tip_of(poses, 0, 0) - (Vec3(1, 2, 3) + expected * Vec3(0, -5, 1))).norm(), 1e-14);
}

TEST(ForwardKinematics, AsfRootTurnsInItsOrientation) {
  // G = C_orient M, and the translation is along the world's axes: C_orient^T e in the joint.
  const Mat3 orient = about(Vec3::UnitY(), 0.8) * about(Vec3::UnitX(), -0.3);
  Skeleton skeleton;
  skeleton.joints.push_back(joint_at("root", kNoParent, {10, 20, 30}));
  skeleton.joints.back().rest_rotation = Quat(orient);
  for (int k = 0; k < 3; ++k) {
    add_dof(skeleton, DofKind::Translation, orient.transpose() * Vec3::Unit(k));
  }
  add_dof(skeleton, DofKind::Rotation, Vec3::UnitZ());
  const Clip clip = clip_of(skeleton, {1, 2, 3, 90});
  const WorldPoses poses = forward_kinematics(skeleton, clip, kAll);
  EXPECT_LT((position_of(poses, 0, 0) - Vec3(11, 22, 33)).norm(), 1e-13);
  EXPECT_LT((rotation_of(poses, 0, 0) - orient * about(Vec3::UnitZ(), std::numbers::pi / 2)).norm(),
            1e-14);
}

TEST(ForwardKinematics, AsfLengthMovesChildrenAndTipsAlongTheBone) {
  Skeleton skeleton;
  skeleton.joints.push_back(joint_at("bone", kNoParent, {0, 0, 0}));
  add_dof(skeleton, DofKind::Rotation, Vec3::UnitZ());
  add_dof(skeleton, DofKind::TailTranslation, Vec3::UnitX());
  skeleton.joints.back().tips = {{"", {2, 0, 0}}};
  skeleton.joints.push_back(joint_at("child", 0, {2, 0, 0}));
  skeleton.joints.push_back(joint_at("grandchild", 1, {1, 0, 0}));
  const Clip clip = clip_of(skeleton, {90, 3});
  const WorldPoses poses = forward_kinematics(skeleton, clip, kAll);
  EXPECT_EQ(position_of(poses, 0, 0), Vec3(0, 0, 0)) << "a tail movement spares its own joint";
  expect_near(tip_of(poses, 0, 0), Vec3(0, 5, 0));
  expect_near(position_of(poses, 0, 1), Vec3(0, 5, 0));
  expect_near(position_of(poses, 0, 2), Vec3(0, 6, 0));  // it is not inherited
}

TEST(ForwardKinematics, BvhScaleMovesChildrenAndTips) {
  Skeleton skeleton;
  skeleton.joints.push_back(joint_at("root", kNoParent, {1, 1, 1}));
  add_dof(skeleton, DofKind::TailScale, Vec3::UnitX(), 1);
  add_dof(skeleton, DofKind::TailScale, Vec3::UnitY(), 1);
  skeleton.joints.back().tips = {{"", {1, 1, 1}}};
  skeleton.joints.push_back(joint_at("child", 0, {1, 10, 100}));
  skeleton.joints.push_back(joint_at("grandchild", 1, {1, 10, 100}));
  const Clip clip = clip_of(skeleton, {2, 0.5});
  const WorldPoses poses = forward_kinematics(skeleton, clip, kAll);
  EXPECT_EQ(position_of(poses, 0, 0), Vec3(1, 1, 1));
  EXPECT_EQ(tip_of(poses, 0, 0), Vec3(3, 1.5, 2));
  EXPECT_EQ(position_of(poses, 0, 1), Vec3(3, 6, 101));
  EXPECT_EQ(position_of(poses, 0, 2), Vec3(4, 16, 201));
}

TEST(ForwardKinematics, RobotJointsTurnAndSlideAfterTheirRestRotation) {
  const Mat3 rest = about(Vec3(1, 1, 0).normalized(), 0.9);
  const Vec3 axis = Vec3(0.2, -0.5, 1).normalized();
  Skeleton skeleton;
  skeleton.angle_unit = AngleUnit::Radians;
  skeleton.joints.push_back(joint_at("revolute", kNoParent, {1, 0, 0}));
  skeleton.joints.back().rest_rotation = Quat(rest);
  add_dof(skeleton, DofKind::Rotation, axis);
  skeleton.joints.push_back(joint_at("prismatic", 0, {0, 2, 0}));
  skeleton.joints.back().rest_rotation = Quat(rest);
  add_dof(skeleton, DofKind::Translation, axis);
  const Clip clip = clip_of(skeleton, {1.2, 0.25});
  const WorldPoses poses = forward_kinematics(skeleton, clip, kAll);
  const Mat3 first = rest * about(axis, 1.2);
  EXPECT_LT((rotation_of(poses, 0, 0) - first).norm(), 1e-14);
  EXPECT_LT(
      (position_of(poses, 0, 1) - (Vec3(1, 0, 0) + first * (Vec3(0, 2, 0) + rest * (0.25 * axis))))
          .norm(),
      1e-14);
  EXPECT_LT((rotation_of(poses, 0, 1) - first * rest).norm(), 1e-14);
}

TEST(ForwardKinematics, NegativeCoordinateAxesTurnTheOtherWay) {
  for (int k = 0; k < 3; ++k) {
    Skeleton skeleton;
    skeleton.joints.push_back(joint_at("j", kNoParent, {0, 0, 0}));
    add_dof(skeleton, DofKind::Rotation, -Vec3::Unit(k));
    const WorldPoses poses = forward_kinematics(skeleton, clip_of(skeleton, {30}), kAll);
    EXPECT_LT((rotation_of(poses, 0, 0) - about(Vec3::Unit(k), -std::numbers::pi / 6)).norm(),
              1e-15);
  }
}

TEST(ForwardKinematics, FreeRootNormalisesItsQuaternionAndLeavesTheClipAlone) {
  Skeleton skeleton;
  skeleton.joints.push_back(joint_at("base", kNoParent, {0, 0, 0}));
  add_dof(skeleton, DofKind::Free, Vec3::UnitX());
  skeleton.joints.push_back(joint_at("link", 0, {1, 0, 0}));
  const Clip clip = clip_of(skeleton, {5, 6, 7, 2, 0, 0, 2});
  const Clip before = clip;
  const WorldPoses poses = forward_kinematics(skeleton, clip, kAll);
  EXPECT_EQ(position_of(poses, 0, 0), Vec3(5, 6, 7));
  EXPECT_LT((position_of(poses, 0, 1) - Vec3(5, 7, 7)).norm(), 1e-15);
  EXPECT_EQ(clip.values, before.values);
}

TEST(ForwardKinematics, AQuaternionOfAnyLengthTurnsAndZeroTurnsNothing) {
  Skeleton skeleton;
  skeleton.joints.push_back(joint_at("base", kNoParent, {0, 0, 0}));
  add_dof(skeleton, DofKind::Free, Vec3::UnitX());
  skeleton.joints.push_back(joint_at("link", 0, {1, 0, 0}));
  const Clip clip = clip_of(skeleton, {0, 0, 0, 1e200,  0, 0, 1e200,  0, 0, 0, 1e-200, 0, 0, 1e-200,
                                       0, 0, 0, 5e-324, 0, 0, 5e-324, 0, 0, 0, 0,      0, 0, 0,
                                       0, 0, 0, 1,      0, 0, -1,     0, 0, 0, NAN,    0, 0, 1});
  const WorldPoses poses = forward_kinematics(skeleton, clip, kAll);
  for (const std::size_t frame : {0u, 1u, 2u}) {
    EXPECT_LT((position_of(poses, frame, 1) - Vec3(0, 1, 0)).norm(), 1e-15) << frame;
  }
  EXPECT_EQ(position_of(poses, 3, 1), Vec3(1, 0, 0));
  EXPECT_LT((position_of(poses, 4, 1) - Vec3(0, -1, 0)).norm(), 1e-15);
  EXPECT_TRUE(std::isnan(position_of(poses, 5, 1).x()));
}

TEST(ForwardKinematics, SharedCoordinatesMoveSeveralJoints) {
  Skeleton skeleton;
  skeleton.joints.push_back(joint_at("a", kNoParent, {0, 0, 0}));
  add_dof(skeleton, DofKind::Rotation, Vec3::UnitZ());
  skeleton.joints.push_back(joint_at("b", 0, {1, 0, 0}));
  skeleton.joints.back().dofs = skeleton.joints.front().dofs;
  skeleton.joints.push_back(joint_at("c", 1, {1, 0, 0}));
  const WorldPoses poses = forward_kinematics(skeleton, clip_of(skeleton, {90}), kAll);
  expect_near(position_of(poses, 0, 2), Vec3(-1, 1, 0));
}

TEST(ForwardKinematics, EveryFrameIsPlacedWhateverTheBlock) {
  Skeleton skeleton;
  skeleton.joints.push_back(joint_at("a", kNoParent, {0, 0, 0}));
  for (int k = 0; k < 3; ++k) add_dof(skeleton, DofKind::Translation, Vec3::Unit(k));
  add_dof(skeleton, DofKind::Rotation, Vec3::UnitZ());
  skeleton.joints.push_back(joint_at("b", 0, {1, 0, 0}));
  for (const std::size_t num_frames : {0u, 1u, 15u, 16u, 17u, 100u}) {
    std::vector<double> values;
    for (std::size_t f = 0; f < num_frames; ++f) {
      const auto x = static_cast<double>(f);
      for (const double value : {x, 2 * x, 3 * x, 7 * x}) values.push_back(value);
    }
    const Clip clip = clip_of(skeleton, values);
    const WorldPoses poses = forward_kinematics(skeleton, clip, kAll);
    ASSERT_EQ(poses.num_frames, num_frames);
    for (std::size_t f = 0; f < num_frames; ++f) {
      const auto x = static_cast<double>(f);
      const double angle = 7 * x * kRadiansPerDegree;
      EXPECT_EQ(position_of(poses, f, 0), Vec3(x, 2 * x, 3 * x));
      const Vec3 expected(x + std::cos(angle), 2 * x + std::sin(angle), 3 * x);
      EXPECT_LT((position_of(poses, f, 1) - expected).norm(), 1e-13);
    }
    // A part of the frames gives the same bits as all of them.
    if (num_frames < 20) continue;
    KinematicsOptions some = kAll;
    some.first_frame = 7;
    some.num_frames = 21;
    const WorldPoses part = forward_kinematics(skeleton, clip, some);
    ASSERT_EQ(part.num_frames, 21u);
    EXPECT_EQ(part.first_frame, 7u);
    for (std::size_t f = 0; f < 21; ++f) {
      EXPECT_EQ(position_of(part, f, 1), position_of(poses, f + 7, 1));
    }
  }
}

TEST(ForwardKinematics, QuaternionsAreCanonical) {
  Skeleton skeleton;
  skeleton.joints.push_back(joint_at("a", kNoParent, {0, 0, 0}));
  for (const int k : {2, 0, 1}) add_dof(skeleton, DofKind::Rotation, Vec3::Unit(k));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-720, 720);
  std::vector<double> values = {180, 0, 0, 0, 180, 0, 0, 0, 180, 0, 0, 0, 90, 0, 0, 0, 0, -180};
  for (int i = 0; i < 3000; ++i) values.push_back(angle(random));
  const Clip clip = clip_of(skeleton, values);
  const WorldPoses poses = forward_kinematics(skeleton, clip, kAll);
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    const double* q = &poses.rotations[f * 4];
    EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-15);
    EXPECT_TRUE(q[0] > 0 || (q[0] == 0 && (q[1] > 0 || (q[1] == 0 && q[2] >= 0)))) << f;
    const auto row = clip.row(f);
    const Mat3 expected = about(Vec3::UnitZ(), row[0] * kRadiansPerDegree) *
                          about(Vec3::UnitX(), row[1] * kRadiansPerDegree) *
                          about(Vec3::UnitY(), row[2] * kRadiansPerDegree);
    EXPECT_LT((rotation_of(poses, f, 0) - expected).norm(), 1e-14);
  }
}

TEST(ForwardKinematics, OddValuesStayWithTheirFrameAndJoints) {
  Skeleton skeleton;
  skeleton.joints.push_back(joint_at("a", kNoParent, {0, 0, 0}));
  skeleton.joints.push_back(joint_at("b", 0, {1, 0, 0}));
  add_dof(skeleton, DofKind::Rotation, Vec3::UnitZ());
  skeleton.joints.push_back(joint_at("c", 1, {1, 0, 0}));
  const WorldPoses poses = forward_kinematics(skeleton, clip_of(skeleton, {0, NAN, 90}), kAll);
  EXPECT_EQ(position_of(poses, 1, 1), Vec3(1, 0, 0));
  EXPECT_TRUE(std::isnan(position_of(poses, 1, 2).x()));
  EXPECT_EQ(position_of(poses, 0, 2), Vec3(2, 0, 0));
  expect_near(position_of(poses, 2, 2), Vec3(1, 1, 0));
}

TEST(LocalPoses, AreInTheParentsFrame) {
  Skeleton skeleton;
  skeleton.joints.push_back(joint_at("a", kNoParent, {0, 0, 9}));
  add_dof(skeleton, DofKind::Rotation, Vec3::UnitZ());
  skeleton.joints.push_back(joint_at("b", 0, {1, 0, 0}));
  add_dof(skeleton, DofKind::Rotation, Vec3::UnitX());
  const LocalPoses poses = local_poses(skeleton, clip_of(skeleton, {90, 90}), kAll);
  EXPECT_EQ(position_of(poses, 0, 0), Vec3(0, 0, 9));
  EXPECT_EQ(position_of(poses, 0, 1), Vec3(1, 0, 0));
  EXPECT_LT((rotation_of(poses, 0, 1) - about(Vec3::UnitX(), std::numbers::pi / 2)).norm(), 1e-15);
}

TEST(BoneDirections, PointToTheChildOrTheirMeanOrTheTip) {
  Skeleton skeleton;
  skeleton.joints.push_back(joint_at("root", kNoParent, {0, 0, 0}));
  skeleton.joints.push_back(joint_at("one", 0, {2, 0, 0}));
  skeleton.joints.push_back(joint_at("left", 1, {0, 1, 3}));
  skeleton.joints.back().tips = {{"", {0, 0, -4}}};
  skeleton.joints.push_back(joint_at("right", 1, {0, 1, -3}));
  skeleton.joints.push_back(joint_at("bare", 3, {0, 0, 0}));
  const auto directions = bone_directions(skeleton);
  EXPECT_EQ(directions[0], Vec3(1, 0, 0));
  EXPECT_EQ(directions[1], Vec3(0, 1, 0));
  EXPECT_EQ(directions[2], Vec3(0, 0, -1));
  EXPECT_EQ(directions[3], Vec3(0, 1, 0)) << "a bone without length";
  EXPECT_EQ(directions[4], Vec3(0, 1, 0)) << "no bone at all";
}

TEST(WorldExtent, HoldsJointsAndTipsAndNothingThatIsNotFinite) {
  Skeleton skeleton;
  skeleton.joints.push_back(joint_at("a", kNoParent, {0, 0, 0}));
  add_dof(skeleton, DofKind::Translation, Vec3::UnitX());
  skeleton.joints.back().tips = {{"", {0, 5, 0}}};
  const Box box = world_extent(skeleton, clip_of(skeleton, {-1, NAN, 4}));
  EXPECT_EQ(box.min, Vec3(-1, 0, 0));
  EXPECT_EQ(box.max, Vec3(4, 5, 0));
}

}  // namespace
}  // namespace kinefile
