// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "kinefile/compare.hpp"
#include "kinefile/robot.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

/// A root, a hinge about z half a metre along x, and a slide along x one metre beyond.
Skeleton robot() {
  Skeleton skeleton;
  skeleton.angle_unit = AngleUnit::Radians;
  skeleton.metres_per_unit = 1;
  const char* const names[] = {"BASE", "HINGE", "SLIDE"};
  for (const char* name : names) skeleton.joints.emplace_back().name = name;
  for (const char* channel : {"x", "y", "z", "qw", "qx", "qy", "qz"}) {
    skeleton.coordinates.push_back({0, channel});
  }
  skeleton.joints[0].dofs = {{DofKind::Free, Vec3::UnitX(), 0, 0}};
  skeleton.joints[1].parent = 0;
  skeleton.joints[1].offset = {0.5, 0, 0};
  skeleton.joints[1].dofs = {{DofKind::Rotation, Vec3::UnitZ(), 7, 0}};
  skeleton.joints[2].parent = 1;
  skeleton.joints[2].offset = {1, 0, 0};
  skeleton.joints[2].dofs = {{DofKind::Translation, Vec3::UnitX(), 8, 0}};
  skeleton.coordinates.push_back({1, "q"});
  skeleton.coordinates.push_back({2, "q"});
  return skeleton;
}

Component component(ComponentKind kind, std::string_view content, std::size_t num_parts,
                    std::vector<double> values) {
  Component made;
  made.kind = kind;
  made.content = content;
  made.num_parts = num_parts;
  made.values = std::move(values);
  made.num_frames = made.values.size() / made.row_size();
  made.timeline = {FrameRate{10}, 0};
  return made;
}

Component root_at(double x, double y, double z, std::size_t num_frames = 1) {
  Component links = component(ComponentKind::Poses, kLinkPosition, 1, {});
  for (std::size_t f = 0; f < num_frames; ++f) {
    for (const double v : {x, y, z, 1.0, 0.0, 0.0, 0.0}) links.values.push_back(v);
  }
  links.num_frames = num_frames;
  return links;
}

Vec3 position(const WorldPoses& poses, std::size_t joint) {
  return Vec3(poses.positions.data() + joint * 3);
}

TEST(BodyBridge, JointsMoveByKinematicsBehindTheRoot) {
  const BodyMotion body{{root_at(1, 2, 3), component(ComponentKind::Values, kJointDisplacement, 2,
                                                     {std::numbers::pi / 2, 0.25})}};
  Diagnostics diagnostics;
  const auto motion = robot::pose(body, robot(), false, diagnostics);
  ASSERT_TRUE(motion);
  EXPECT_TRUE(diagnostics.items().empty()) << text_of(diagnostics);
  const WorldPoses poses = forward_kinematics(motion->skeleton, motion->clip);
  EXPECT_NEAR((position(poses, 1) - Vec3(1.5, 2, 3)).norm(), 0, 1e-15);
  EXPECT_NEAR((position(poses, 2) - Vec3(1.5, 3.25, 3)).norm(), 0, 1e-15);
}

/// The robot, with a second hinge that mimics the first: half as far, the other way around, 0.1
/// further. It has the id 2.
Skeleton robot_with_mimic() {
  Skeleton skeleton = robot();
  Joint mimic;
  mimic.name = "MIMIC";
  mimic.parent = 2;
  mimic.offset = {0, 1, 0};
  mimic.dofs = {{DofKind::Rotation, Vec3::UnitX(), 7, 0}};
  mimic.dofs[0].gain = -0.5;
  mimic.dofs[0].shift = 0.1;
  skeleton.joints.push_back(mimic);
  skeleton.coordinates.push_back({3, "q"});
  return skeleton;
}

TEST(BodyBridge, AMimicJointFollowsAndHasItsValueInWhatIsWritten) {
  const BodyMotion body{
      {root_at(0, 0, 0), component(ComponentKind::Values, kJointDisplacement, 2, {0.4, 0.25})}};
  Diagnostics diagnostics;
  auto motion = robot::pose(body, robot_with_mimic(), false, diagnostics);
  ASSERT_TRUE(motion);
  EXPECT_EQ(codes_of(diagnostics), std::vector<std::string>{"BRG014"}) << "two joints of three";
  EXPECT_NEAR(motion->clip.row(0)[9], -0.1, 1e-15);
  motion->clip.mutate()[0][7] = 1;
  const auto written = robot::project(*motion, robot::BodyForm::Joints, nullptr, diagnostics);
  ASSERT_TRUE(written);
  EXPECT_EQ(written->components[1].num_parts, 3u);
  EXPECT_EQ(written->components[1].row(0)[2], -0.4);
  // The links are where the joint follows to, and give the same joints back.
  const auto links = robot::project(*motion, robot::BodyForm::Links, nullptr, diagnostics);
  const auto again = robot::pose(*links, robot_with_mimic(), false, diagnostics);
  ASSERT_TRUE(again);
  EXPECT_NEAR(again->clip.row(0)[7], 1, 1e-12);
  EXPECT_NEAR(again->clip.row(0)[9], -0.4, 1e-12);
}

TEST(BodyBridge, AMimicJointThatWasRecordedElsewhereIsToldAndFollows) {
  BodyMotion body{{root_at(0, 0, 0, 2), component(ComponentKind::Values, kJointDisplacement, 3,
                                                  {0.4, 0.25, -0.1, 0.8, 0.25, 0.5})}};
  Diagnostics diagnostics;
  const auto refused = robot::pose(body, robot_with_mimic(), false, diagnostics);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "BRG017");
  EXPECT_EQ(refused.error().kind, ErrorKind::DataLoss);
  EXPECT_EQ(refused.error().message,
            "the joint of 'MIMIC' follows that of 'HINGE' in the model, but moves by itself in the "
            "motion: 0.8 away at the most (frame 1); --lenient lets it follow");
  const auto followed = robot::pose(body, robot_with_mimic(), true, diagnostics);
  ASSERT_TRUE(followed);
  EXPECT_EQ(codes_of(diagnostics), std::vector<std::string>{"BRG017"});
  EXPECT_NEAR(followed->clip.row(1)[9], -0.3, 1e-15);
  // What rounding to six digits leaves is no difference.
  body.components[1].values = {0.4, 0.25, -0.1000005, 0.8, 0.25, -0.2999995};
  Diagnostics none;
  const auto rounded = robot::pose(body, robot_with_mimic(), false, none);
  ASSERT_TRUE(rounded);
  EXPECT_TRUE(none.items().empty());
  EXPECT_EQ(rounded->clip.row(0)[9], -0.1000005) << "as it was recorded";
}

TEST(BodyBridge, JointsOfAnotherLengthAreRefusedOrCutOrHeld) {
  BodyMotion body{{root_at(0, 0, 0, 2), component(ComponentKind::Values, kJointDisplacement, 2,
                                                  {0.1, 0, 0.2, 0, 0.3, 0})}};
  Diagnostics diagnostics;
  const auto too_long = robot::pose(body, robot(), false, diagnostics);
  ASSERT_FALSE(too_long);
  EXPECT_EQ(too_long.error().code, "BRG021");
  EXPECT_EQ(too_long.error().kind, ErrorKind::DataLoss);
  const auto cut = robot::pose(body, robot(), true, diagnostics);
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->clip.num_frames, 2u);
  EXPECT_EQ(codes_of(diagnostics), std::vector<std::string>{"BRG014"});

  body.components[0] = root_at(0, 0, 0, 5);
  const auto refused = robot::pose(body, robot(), false, diagnostics);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "BRG011");
  const auto held = robot::pose(body, robot(), true, diagnostics);
  ASSERT_TRUE(held);
  EXPECT_EQ(held->clip.row(4)[7], 0.3);
}

TEST(BodyBridge, ComponentsOfDifferentRatesAreRefusedOrTakenByTheirNumbers) {
  BodyMotion body{
      {root_at(0, 0, 0, 2), component(ComponentKind::Values, kJointDisplacement, 1, {0.1, 0.2})}};
  body.components[0].timeline = {FrameRate{100}, 0};
  body.components[1].timeline = {FrameRate{50}, 0};
  Diagnostics diagnostics;
  const auto table = robot::motion_of_components(body, false, diagnostics);
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().kind, ErrorKind::DataLoss);
  EXPECT_EQ(table.error().code, "BRG021");
  EXPECT_EQ(table.error().message,
            "expected components of one length and rate, found 2 frames at 50 a second of "
            "'JointDisplacement' beside 2 at 100 of 'LinkPosition'; 'kinefile resample --fps 100' "
            "brings them to one, --lenient leaves some out");
  const auto on_robot = robot::pose(body, robot(), false, diagnostics);
  ASSERT_FALSE(on_robot);
  EXPECT_EQ(on_robot.error().code, "BRG021");
  EXPECT_TRUE(diagnostics.items().empty());
  const auto some = robot::motion_of_components(body, true, diagnostics);
  ASSERT_TRUE(some);
  EXPECT_EQ(some->clip.num_coordinates, 7u) << "the links alone";
  EXPECT_EQ(codes_of(diagnostics), std::vector<std::string>{"BRG014"});
}

TEST(BodyBridge, NoComponentsAreNoTable) {
  Diagnostics diagnostics;
  const auto refused = robot::motion_of_components({}, false, diagnostics);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "BRG010");
}

TEST(BodyBridge, CountsThatAreNotTheModelsAreTold) {
  const BodyMotion body{
      {root_at(0, 0, 0), component(ComponentKind::Values, kJointDisplacement, 3, {0.1, 0.2, 9})}};
  Diagnostics diagnostics;
  const auto motion = robot::pose(body, robot(), false, diagnostics);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->clip.row(0)[8], 0.2);
  ASSERT_EQ(diagnostics.items().size(), 1u);
  EXPECT_EQ(diagnostics.items()[0].message,
            "the model has 2 joints, the motion 3; the last ones are left out");
}

TEST(BodyBridge, RollPitchYawStaysInTheRoot) {
  Component links = component(ComponentKind::Poses, kLinkPosition, 1, {});
  links.pose_form = PoseForm::RollPitchYaw;
  links.values = {1, 2, 3, 0.1, 0.2, 0.3};
  links.num_frames = 1;
  const BodyMotion body{
      {links, component(ComponentKind::Values, kJointDisplacement, 2, {0.5, 0.25})}};
  Diagnostics diagnostics;
  const auto motion = robot::pose(body, robot(), false, diagnostics);
  ASSERT_TRUE(motion);
  ASSERT_TRUE(validate(motion->skeleton));
  EXPECT_EQ(motion->clip.values, (std::vector<double>{1, 2, 3, 0.1, 0.2, 0.3, 0.5, 0.25}));
  const WorldPoses poses = forward_kinematics(motion->skeleton, motion->clip, {.rotations = true});
  const auto q = quaternion_of_pose(PoseForm::RollPitchYaw, links.row(0));
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(poses.rotations[k], q[k], 1e-15);
}

TEST(BodyBridge, RecordedLinksStandInThePlaceOfComputedOnesAndMoveNoOthers) {
  // Two of three links were recorded: the slide follows the hinge of the kinematics.
  Component links =
      component(ComponentKind::Poses, kLinkPosition, 2, {0, 0, 1, 1, 0, 0, 0, 5, 5, 5, 0, 0, 0, 2});
  const BodyMotion body{{links, component(ComponentKind::Values, kJointDisplacement, 2, {0, 0.5})}};
  Diagnostics diagnostics;
  const auto motion = robot::pose(body, robot(), false, diagnostics);
  ASSERT_TRUE(motion);
  WorldPoses poses = forward_kinematics(motion->skeleton, motion->clip, {.rotations = true});
  robot::put_recorded_links(body, motion->skeleton, poses);
  EXPECT_EQ(position(poses, 1), Vec3(5, 5, 5));
  EXPECT_NEAR((position(poses, 2) - Vec3(2, 0, 1)).norm(), 0, 1e-15);
  EXPECT_EQ(poses.rotations[7], 1);  // of unit length
}

TEST(BodyBridge, AllLinksGiveTheJointsBack) {
  std::vector<double> values;
  for (int f = 0; f < 50; ++f) {  // the hinge turns more than once around
    values.push_back(0.2 * f);
    values.push_back(0.01 * f);
  }
  const BodyMotion body{
      {root_at(1, 2, 3, 50), component(ComponentKind::Values, kJointDisplacement, 2, values)}};
  Diagnostics diagnostics;
  const auto motion = robot::pose(body, robot(), false, diagnostics);
  ASSERT_TRUE(motion);
  const auto links = robot::project(*motion, robot::BodyForm::Links, nullptr, diagnostics);
  ASSERT_TRUE(links);
  ASSERT_EQ(links->components.size(), 1u);
  const auto again = robot::pose(*links, robot(), false, diagnostics);
  ASSERT_TRUE(again);
  for (std::size_t f = 0; f < 50; ++f) {
    EXPECT_NEAR(again->clip.row(f)[7], 0.2 * static_cast<double>(f), 1e-12);
    EXPECT_NEAR(again->clip.row(f)[8], 0.01 * static_cast<double>(f), 1e-12);
  }
}

TEST(BodyBridge, AZmpGoesIntoTheWorldAndBack) {
  // The root is turned by a quarter about z: its x is the world's y.
  Component links = component(ComponentKind::Poses, kLinkPosition, 1,
                              {1, 2, 3, std::sqrt(0.5), 0, 0, std::sqrt(0.5)});
  Component zmp = component(ComponentKind::Vectors, kZmp, 1, {0.5, 0, -3});
  zmp.is_root_relative = true;
  const BodyMotion body{{links, zmp}};
  Diagnostics diagnostics;
  const auto world = robot::zmp(body, false, diagnostics);
  ASSERT_TRUE(world);
  const auto point = world->components[1].row(0);
  EXPECT_NEAR((Vec3(point[0], point[1], point[2]) - Vec3(1, 2.5, 0)).norm(), 0, 1e-15);
  const auto back = robot::zmp(*world, true, diagnostics);
  ASSERT_TRUE(back);
  const auto own = back->components[1].row(0);
  EXPECT_NEAR((Vec3(own[0], own[1], own[2]) - Vec3(0.5, 0, -3)).norm(), 0, 1e-15);
}

TEST(BodyBridge, PartsComeBackAsTheyWere) {
  for (const PoseForm form : {PoseForm::Quaternion, PoseForm::RollPitchYaw}) {
    Component links = component(ComponentKind::Poses, kLinkPosition, 2, {});
    links.pose_form = form;
    links.num_frames = 3;
    for (std::size_t i = 0; i < 3 * links.row_size(); ++i) {
      links.values.push_back(std::sin(static_cast<double>(i)));
    }
    const Motion motion = robot::motion_of_component(links);
    EXPECT_TRUE(validate(motion.skeleton));
    EXPECT_EQ(robot::with_frames_of(links, motion).values, links.values);
  }
}

TEST(BodyBridge, JointsThatMoveFreelyGetThreePositionsAndThreeAngles) {
  Component links = component(ComponentKind::Poses, kLinkPosition, 2, {});
  links.num_frames = 20;
  for (int f = 0; f < 20; ++f) {
    for (int link = 0; link < 2; ++link) {
      const double angle = 0.3 * f + link;
      for (const double v :
           {0.1 * f, 1.0, 2.0, std::cos(angle / 2), 0.0, 0.0, std::sin(angle / 2)}) {
        links.values.push_back(v);
      }
    }
  }
  const Motion free = robot::motion_of_component(links);
  const Motion bound = robot::without_free_joints(free);
  ASSERT_TRUE(validate(bound.skeleton));
  const MotionComparison comparison = compare_motions(free, bound);
  EXPECT_LT(comparison.distance.value, 1e-14);
  EXPECT_LT(comparison.rotation.value, 1e-5);
  EXPECT_NEAR(bound.clip.row(19)[3], 0.3 * 19, 1e-12);  // no jump at half a turn
}

TEST(BodyBridge, ARobotInOtherUnitsIsProjectedInMetresAndRadians) {
  Motion motion{robot(), {}};
  motion.skeleton.metres_per_unit = 0.01;
  motion.skeleton.angle_unit = AngleUnit::Degrees;
  motion.clip.num_frames = 1;
  motion.clip.num_coordinates = 9;
  motion.clip.values = {100, 200, 300, 1, 0, 0, 0, 90, 50};
  Diagnostics diagnostics;
  const auto body = robot::project(motion, robot::BodyForm::Joints, nullptr, diagnostics);
  ASSERT_TRUE(body);
  EXPECT_EQ(body->components[0].values, (Array<double>{1, 2, 3, 1, 0, 0, 0}));
  EXPECT_EQ(body->components[1].values, (Array<double>{90 * kRadiansPerDegree, 0.5}));
}

/// A robot with a shoulder whose first and third axes are oblique to each other, 16 degrees off a
/// right angle, as some robots' are; each is at a right angle to the second.
Skeleton robot_with_oblique_shoulder() {
  Skeleton skeleton = robot();
  skeleton.joints.resize(1);
  skeleton.coordinates.resize(kRootColumns);
  const Vec3 axes[] = {Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitZ()};
  for (std::size_t j = 1; j <= 3; ++j) {
    Joint& joint = skeleton.joints.emplace_back();
    joint.name = j == 3 ? "ARM" : "SHOULDER" + std::to_string(j);
    joint.parent = j - 1;
    joint.dofs = {{DofKind::Rotation, axes[j - 1], kRootColumns + j - 1, 0}};
    skeleton.coordinates.push_back({j, "q"});
  }
  skeleton.joints[2].rest_rotation = Quat(Eigen::AngleAxisd(0.28, Vec3::UnitX()));
  return skeleton;
}

TEST(BodyBridge, ObliqueShouldersFollowExactly) {
  Motion figure;
  figure.skeleton.metres_per_unit = 1;
  figure.skeleton.joints.resize(2);
  figure.skeleton.joints[0].name = "BASE";
  figure.skeleton.joints[1].name = "ARM";
  figure.skeleton.joints[1].parent = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    figure.skeleton.joints[1].dofs.push_back(
        {DofKind::Rotation, Vec3::Unit(static_cast<Eigen::Index>(k)), k, 0});
    figure.skeleton.coordinates.push_back({1, channel_name(DofKind::Rotation, k)});
  }
  figure.clip.num_coordinates = 3;
  figure.clip.num_frames = 600;  // more than one block
  for (int f = 0; f < 600; ++f) {
    for (const double rate : {0.31, 0.17, 0.23}) {
      figure.clip.values.push_back(60 * std::sin(rate * f));
    }
  }
  const Skeleton robot = robot_with_oblique_shoulder();
  Diagnostics diagnostics;
  const auto body = robot::onto_robot(figure, robot, {}, true, diagnostics);
  ASSERT_TRUE(body);
  EXPECT_EQ(diagnostics.count_of("BRG015", Severity::Warning), 0u) << text_of(diagnostics);
  const auto motion = robot::pose(*body, robot, false, diagnostics);
  ASSERT_TRUE(motion);
  const WorldPoses poses = forward_kinematics(robot, motion->clip, {.rotations = true});
  const WorldPoses wanted = forward_kinematics(figure.skeleton, figure.clip, {.rotations = true});
  const auto at = [](const WorldPoses& all, std::size_t index) {
    const double* q = all.rotations.data() + index * 4;
    return Quat(q[0], q[1], q[2], q[3]);
  };
  for (std::size_t f = 0; f < 600; ++f) {
    const Quat rest = robot.joints[2].rest_rotation;  // of the arm, too
    EXPECT_LT((at(wanted, f * 2 + 1) * rest).angularDistance(at(poses, f * 4 + 3)), 1e-6) << f;
  }
}

/// A robot that faces +x, with one joint about y in each hip.
Skeleton robot_with_hips() {
  Skeleton robot;
  robot.angle_unit = AngleUnit::Radians;
  robot.metres_per_unit = 1;
  robot.up = 2;
  for (std::size_t c = 0; c < kRootColumns + 2; ++c) robot.coordinates.push_back({0, "q"});
  Joint waist;
  waist.name = "WAIST";
  waist.dofs = {{DofKind::Free, Vec3::UnitX(), 0, 0}};
  robot.joints = {waist};
  for (const char* name : {"L_HIP", "R_HIP"}) {
    Joint hip;
    hip.name = name;
    hip.parent = 0;
    hip.offset = {0, robot.joints.size() == 1 ? 0.1 : -0.1, 0};
    hip.dofs = {{DofKind::Rotation, Vec3::UnitY(), kRootColumns + robot.joints.size() - 1, 0}};
    robot.joints.push_back(hip);
  }
  return robot;
}

/// A figure with the same names that faces -y, as one that faced +z when y was up.
/// \param angles  of the left hip, about x, y and z
Motion figure_with_hips(const Vec3& angles) {
  Motion figure;
  figure.skeleton.metres_per_unit = 1;
  figure.skeleton.up = 2;
  for (const char* name : {"WAIST", "L_HIP", "R_HIP"}) {
    Joint joint;
    joint.name = name;
    const std::size_t j = figure.skeleton.joints.size();
    if (j > 0) joint.parent = 0;
    if (j > 0) joint.offset = {j == 1 ? 0.1 : -0.1, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto kind = j == 0 ? DofKind::Translation : DofKind::Rotation;
      joint.dofs.push_back({kind, Vec3::Unit(static_cast<Eigen::Index>(k)), 3 * j + k, 0});
      figure.skeleton.coordinates.push_back({j, channel_name(kind, k)});
    }
    figure.skeleton.joints.push_back(joint);
  }
  figure.clip.num_frames = 1;
  figure.clip.num_coordinates = 9;
  figure.clip.values = {0, -2, 1, angles[0], angles[1], angles[2], 0, 0, 0};
  return figure;
}

TEST(BodyBridge, AFigureIsTurnedToFaceAsTheRobotDoes) {
  const Skeleton robot = robot_with_hips();
  Diagnostics diagnostics;
  const auto body = robot::onto_robot(figure_with_hips({20, 0, 0}), robot, {}, false, diagnostics);
  ASSERT_TRUE(body) << to_string(body.error());
  EXPECT_EQ(codes_of(diagnostics), std::vector<std::string>{"BRG018"});
  const auto motion = robot::pose(*body, robot, false, diagnostics);
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->clip.row(0)[0], 2, 1e-12);  // what went along -y goes along x
  EXPECT_NEAR(motion->clip.row(0)[1], 0, 1e-12);
  EXPECT_NEAR(motion->clip.row(0)[2], 1, 1e-12);
  EXPECT_NEAR(motion->clip.row(0)[3], 1, 1e-12);  // the root is not turned
  EXPECT_NEAR(motion->clip.row(0)[kRootColumns], 20 * kRadiansPerDegree, 1e-12);
}

TEST(BodyBridge, ARobotThatCannotDoItIsRefusedBeyondThirtyDegrees) {
  const Skeleton robot = robot_with_hips();
  Diagnostics diagnostics;
  EXPECT_TRUE(robot::onto_robot(figure_with_hips({0, 0, 29}), robot, {}, false, diagnostics));
  const Motion turned = figure_with_hips({0, 0, 40});
  const auto refused = robot::onto_robot(turned, robot, {}, false, diagnostics);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::DataLoss);
  EXPECT_EQ(refused.error().message,
            "the robot cannot do what the figure does: up to 40 degrees would be lost in 'L_HIP "
            "(L_HIP)'; --lenient goes on");
  EXPECT_TRUE(robot::onto_robot(turned, robot, {}, true, diagnostics));
}

TEST(BodyBridge, AFigureThatDoesNotStandAtRestIsRefused) {
  Motion figure = figure_with_hips({0, 0, 0});
  for (std::size_t j = 1; j < 3; ++j) {
    figure.skeleton.joints[j].name = j == 1 ? "L_LEG" : "R_LEG";
    figure.skeleton.joints[j].tips = {{"", {0.8, 0, 0}}};
  }
  robot::RobotNames names;
  names.source_of = {{"L_HIP", "L_LEG"}, {"R_HIP", "R_LEG"}};
  Diagnostics diagnostics;
  const auto refused = robot::onto_robot(figure, robot_with_hips(), names, false, diagnostics);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "BRG020");
  for (std::size_t j = 1; j < 3; ++j) figure.skeleton.joints[j].tips[0].offset = {0, 0, -0.8};
  EXPECT_TRUE(robot::onto_robot(figure, robot_with_hips(), names, false, diagnostics));
}

TEST(BodyBridge, AZmpAtOtherTimesThanTheRootIsRefused) {
  BodyMotion body;
  Component links;
  links.kind = ComponentKind::Poses;
  links.content = kLinkPosition;
  links.num_parts = 1;
  links.num_frames = 2;
  links.timeline.given = FrameRate{100};
  links.values = {0, 0, 1, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0};
  Component zmp;
  zmp.kind = ComponentKind::Vectors;
  zmp.content = kZmp;
  zmp.num_parts = 1;
  zmp.num_frames = 2;
  zmp.timeline.given = FrameRate{50};
  zmp.values = {0, 0, 0, 1, 0, 0};
  body.components = {links, zmp};
  Diagnostics diagnostics;
  const auto refused = robot::zmp(body, true, diagnostics);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::DataLoss);
  body.components[1].timeline.given = FrameRate{100};
  EXPECT_TRUE(robot::zmp(body, true, diagnostics));
}

}  // namespace
}  // namespace kinefile::test
