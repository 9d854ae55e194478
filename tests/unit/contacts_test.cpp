// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "kinefile/retime.hpp"
#include "retime/feet.hpp"
#include "support/figures.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

/// A hopper of 1.7 m: a body on one foot, 100 frames a second. It stands, flies from frame 50 to
/// frame 99, and stands.
/// \param up  1 for y, 2 for z
Motion hopper(std::size_t up = 1, double unit = 1) {
  const auto axis = static_cast<Eigen::Index>(up);
  Motion motion;
  Joint body;
  body.name = "Body";
  body.dofs.push_back({DofKind::Translation, Vec3::Unit(axis), 0, 0});
  Joint foot;
  foot.name = "LeftFoot";
  foot.parent = 0;
  foot.offset = -1.7 * unit * Vec3::Unit(axis);
  motion.skeleton.joints = {body, foot};
  motion.skeleton.coordinates = {{0, "position"}};
  motion.clip.num_frames = 150;
  motion.clip.num_coordinates = 1;
  motion.clip.timeline = {FrameRate{100}, 0};
  for (int f = 0; f < 150; ++f) {
    const double time = (f - 49) * 0.01;
    const bool is_flying = f > 49 && f < 100;
    motion.clip.values.push_back(is_flying ? unit * 4.9 * time * (0.51 - time) : 0);
  }
  EXPECT_TRUE(validate(motion.skeleton));
  return motion;
}

std::vector<double> weights_of(const Motion& motion, std::vector<std::string> notes) {
  Diagnostics diagnostics;
  const auto weights = retime::contact_weights(motion, diagnostics);
  EXPECT_TRUE(weights) << to_string(weights.error());
  EXPECT_EQ(test::codes_of(diagnostics), notes);
  return weights ? *weights : std::vector<double>{};
}

void expect_hop(const std::vector<double>& weights) {
  ASSERT_EQ(weights.size(), 150u);
  for (std::size_t f = 0; f < 48; ++f) EXPECT_EQ(weights[f], 1) << f;
  for (std::size_t f = 51; f < 99; ++f) EXPECT_EQ(weights[f], 0) << f;
  for (std::size_t f = 102; f < 150; ++f) EXPECT_EQ(weights[f], 1) << f;
}

TEST(ContactWeights, FlightKeepsItsRate) { expect_hop(weights_of(hopper(), {"RTM006"})); }

TEST(ContactWeights, FindsWhereUpIs) { expect_hop(weights_of(hopper(2), {"RTM006"})); }

TEST(ContactWeights, TakesTheStandingFigureForAPerson) {
  Diagnostics diagnostics;
  EXPECT_TRUE(retime::contact_weights(hopper(1, 100), diagnostics));
  EXPECT_EQ(test::text_of(diagnostics),
            "note[RTM006]: the motion has no unit of length; the figure, which stands 170 units "
            "high, is taken to be 1.7 m tall (--unit-in says otherwise)\n");
  expect_hop(weights_of(hopper(1, 0.001), {"RTM006"}));
}

TEST(ContactWeights, TakesTheUnitFromTheFramesWhereTheRestPoseIsFlat) {
  // All bones are along x at rest, 16 units high; the figure stands 161 units high, on still feet.
  const std::vector<test::Bone> bones = {
      {"Hips", 0, {0, 0, 0}},       {"Spine", 1, {12, 2, 0}, Vec3(60, 0, 0)},
      {"LeftLeg", 1, {-5, 0, 9}},   {"LeftFoot", 2, {-84, 0, 0}, Vec3(0, -14, 0)},
      {"RightLeg", 1, {-5, 0, -9}}, {"RightFoot", 2, {-84, 0, 0}, Vec3(0, -14, 0)}};
  std::vector<std::vector<double>> rows;
  for (int f = 0; f < 60; ++f) rows.push_back(test::row_of(bones, {0.1 * f, 89, 0, 90}));
  const Motion motion = test::motion_of(test::bvh_of_figure(bones, rows, 0.01));
  const auto weights = weights_of(motion, {"RTM006"});
  EXPECT_EQ(std::count(weights.begin(), weights.end(), 1.0), 60);
}

TEST(ContactWeights, UsesTheUnitOfTheMotion) {
  Motion motion = hopper(1, 100);
  motion.skeleton.metres_per_unit = 0.01;
  expect_hop(weights_of(motion, {}));
}

TEST(ContactWeights, AShortTouchIsNoContact) {
  Motion motion = hopper();
  for (std::size_t f = 72; f < 78; ++f) motion.clip.values.mutate()[f] = 0;  // 50 ms
  expect_hop(weights_of(motion, {"RTM006"}));
}

TEST(ContactWeights, AFootThatSlidesIsNotOnTheGround) {
  Motion motion = hopper();
  motion.skeleton.joints[0].dofs.insert(motion.skeleton.joints[0].dofs.begin(),
                                        {DofKind::Translation, Vec3::UnitX(), 1, 0});
  motion.skeleton.coordinates.push_back({0, "Xposition"});
  std::vector<double> values;
  for (int f = 0; f < 150; ++f) {
    values.push_back(motion.clip.values[std::size_t(f)]);
    values.push_back(f < 75 ? f * 0.003 : 0);  // 0.3 m/s
  }
  motion.clip.values = values;
  motion.clip.num_coordinates = 2;
  const auto weights = weights_of(motion, {"RTM006"});
  EXPECT_EQ(std::count(weights.begin(), weights.begin() + 75, 1.0), 0);
  EXPECT_EQ(weights[120], 1);
}

TEST(ContactWeights, FramesThatAreNotFiniteAreNoContact) {
  Motion motion = hopper();
  motion.clip.values.mutate()[20] = std::numeric_limits<double>::quiet_NaN();
  const auto weights = weights_of(motion, {"RTM006"});
  EXPECT_EQ(weights[20], 0);
  EXPECT_EQ(weights[5], 1);
  EXPECT_EQ(weights[40], 1);
}

TEST(ContactWeights, MotionsWithoutFramesHaveNone) {
  Motion motion = hopper();
  motion.clip.values.clear();
  motion.clip.num_frames = 0;
  EXPECT_TRUE(weights_of(motion, {"RTM006"}).empty());
}

TEST(GroundContacts, AreRunsOfFramesOfAPoint) {
  Motion motion = hopper();
  motion.skeleton.metres_per_unit = 1;
  motion.skeleton.joints[0].tips.push_back({"Crown", {0, 0.1, 0}});
  motion.skeleton.joints[1].tips.push_back({"Toe", {0.1, -0.01, 0}});
  Diagnostics diagnostics;
  const auto contacts = retime::ground_contacts(motion, diagnostics);
  ASSERT_TRUE(contacts);
  ASSERT_EQ(contacts->size(), 4u);  // the foot before and after its flight, then its tip
  EXPECT_EQ(test::text_of(diagnostics), "");
  for (std::size_t c = 0; c < 4; ++c) {
    const retime::GroundContact& contact = (*contacts)[c];
    EXPECT_EQ(contact.joint, 1u);
    EXPECT_EQ(contact.is_tip, c >= 2);
    EXPECT_EQ(contact.tip, contact.is_tip ? 1u : 0u) << "after the crown";
    const bool is_first = c % 2 == 0;
    EXPECT_NEAR(double(contact.first_frame), is_first ? 0 : 100, 1) << c;
    EXPECT_NEAR(double(contact.first_frame + contact.num_frames), is_first ? 50 : 150, 1) << c;
  }
}

TEST(GroundContacts, AreWhereWeightsAreOne) {
  Motion motion = hopper();
  motion.skeleton.joints[1].tips.push_back({"Toe", {0.1, -0.01, 0}});
  Diagnostics diagnostics;
  const auto contacts = retime::ground_contacts(motion, diagnostics);
  ASSERT_TRUE(contacts);
  std::vector<double> expected(150, 0.0);
  for (const retime::GroundContact& contact : *contacts) {
    for (std::size_t f = 0; f < contact.num_frames; ++f) expected[contact.first_frame + f] = 1;
  }
  EXPECT_EQ(weights_of(motion, test::codes_of(diagnostics)), expected);
}

TEST(GroundContacts, ASingleFrameIsTooShort) {
  Motion motion = hopper();
  motion.clip.values.resize(1);
  motion.clip.num_frames = 1;
  const auto contacts = retime::ground_contacts(motion, test::ignored());
  ASSERT_TRUE(contacts);
  EXPECT_TRUE(contacts->empty());
}

TEST(ContactWeights, NeedFeet) {
  Motion motion = hopper();
  motion.skeleton.joints[1].name = "Eyeball";
  Diagnostics diagnostics;
  const auto weights = retime::contact_weights(motion, diagnostics);
  ASSERT_FALSE(weights);
  EXPECT_EQ(weights.error().code, "RTM003");
  EXPECT_EQ(weights.error().kind, ErrorKind::Usage);
}

TEST(ContactWeights, FindThePointsThatTouchTheGround) {
  const Motion walk = examples::make_walk({.num_frames = 2});
  const auto points = retime::find_foot_points(walk.skeleton);
  ASSERT_EQ(points.size(), 4u);  // toes and their tips
  EXPECT_EQ(walk.skeleton.joints[points[0].joint].name, "LeftToe");
  EXPECT_EQ(walk.skeleton.joints[points[2].joint].name, "RightToe");
  EXPECT_FALSE(points[0].is_tip);
  EXPECT_TRUE(points[1].is_tip);
  for (const char* name : {"lfoot", "RTOES", "LeftAnkle", "ball_l", "\u5de6\u8db3\u9996"}) {
    Motion motion = hopper();
    motion.skeleton.joints[1].name = name;
    EXPECT_EQ(retime::find_foot_points(motion.skeleton).size(), 1u) << name;
  }
}

}  // namespace
}  // namespace kinefile
