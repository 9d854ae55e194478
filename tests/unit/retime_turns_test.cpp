// SPDX-License-Identifier: MIT
// Angles that are interpolated as numbers take the short way round.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "kinefile/edit.hpp"
#include "kinefile/retime.hpp"
#include "support/motions.hpp"
#include "support/support.hpp"

namespace kinefile {
namespace {

using retime::RotationInterpolation;
using test::constant_rate;
using test::retimed;

constexpr RotationInterpolation kAllKinds[] = {
    RotationInterpolation::Slerp, RotationInterpolation::Nlerp, RotationInterpolation::Cubic,
    RotationInterpolation::Euler};

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A joint that turns about one axis; a number a frame, in degrees.
Motion wheel(const std::vector<double>& angles, AngleUnit unit = AngleUnit::Degrees) {
  std::vector<Vec3> rows;
  const double scale = unit == AngleUnit::Degrees ? 1 : kRadiansPerDegree;
  for (const double angle : angles) rows.emplace_back(scale * angle, 0, 0);
  Motion motion = test::turning_motion({Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()}, rows, unit);
  motion.skeleton.joints[0].dofs.resize(1);
  return motion;
}

/// An angle in degrees within half a turn of 0.
double wrapped(double degrees) { return std::remainder(degrees, 360); }

std::vector<double> wrapped(std::vector<double> angles) {
  for (double& angle : angles) angle = wrapped(angle);
  return angles;
}

TEST(RetimeTurns, AJointOfOneAngleGoesTheShortWay) {
  for (const AngleUnit unit : {AngleUnit::Degrees, AngleUnit::Radians}) {
    const double degrees = unit == AngleUnit::Degrees ? 1 : 1 / kRadiansPerDegree;
    for (const RotationInterpolation rotation : kAllKinds) {
      const Motion slow = retimed(wheel({170, 179, -172, -163}, unit), constant_rate(7, 0.5),
                                  {.rotation = rotation});
      EXPECT_NEAR(degrees * slow.clip.row(1)[0], 174.5, 1e-12);
      EXPECT_NEAR(degrees * slow.clip.row(3)[0], 183.5, 1e-12);
      EXPECT_NEAR(degrees * slow.clip.row(5)[0], -167.5, 1e-12);
      EXPECT_NEAR(degrees * slow.clip.row(4)[0], -172, 1e-12) << "whole frames are copies";
    }
  }
}

TEST(RetimeTurns, SoDoTwoAnglesAndThreeAngleByAngle) {
  Motion arm = test::turning_motion({Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()},
                                    {{175, -179, 350}, {-177, 177, 4}});
  const Motion three = retimed(arm, {{0.5}}, {.rotation = RotationInterpolation::Euler});
  EXPECT_EQ(three.clip.values, (std::vector<double>{179, -181, 357}));
  arm.skeleton.joints[0].dofs.pop_back();
  for (const RotationInterpolation rotation : kAllKinds) {
    const Motion two = retimed(arm, {{0.5}}, {.rotation = rotation});
    EXPECT_EQ(two.clip.row(0)[0], 179);
    EXPECT_EQ(two.clip.row(0)[1], -181);
    EXPECT_EQ(two.clip.row(0)[2], 177) << "a column that nothing reads is no angle";
  }
}

TEST(RetimeTurns, AStepOfHalfATurnStaysAsItIs) {
  for (const double end : {180.0, -180.0, 179.9, -179.9}) {
    EXPECT_EQ(retimed(wheel({0, end}), {{0.25}}).clip.row(0)[0], 0.25 * end);
    EXPECT_EQ(retimed(wheel({720, 720 + end}), {{0.25}}).clip.row(0)[0], 720 + 0.25 * end);
  }
  EXPECT_NEAR(retimed(wheel({0, 200}), {{0.25}}).clip.row(0)[0], -40, 1e-12);
  EXPECT_NEAR(retimed(wheel({0, -890}), {{0.5}}).clip.row(0)[0], -85, 1e-12);
}

TEST(RetimeTurns, AllKindsGiveWhatTheyGiveForAnglesThatDoNotJump) {
  std::vector<double> angles = {0};
  std::mt19937 random(12);
  std::uniform_real_distribution<double> step(-175, 175);
  while (angles.size() < 200) angles.push_back(angles.back() + step(random));
  const Motion smooth = wheel(angles);
  const Motion jumping = wheel(wrapped(angles));
  for (const bool antialias : {false, true}) {
    for (const RotationInterpolation rotation : kAllKinds) {
      for (const double rate : {0.3, 0.99, 1.7, 6.4}) {
        const retime::TimeMap map = constant_rate(static_cast<std::size_t>(199 / rate), rate);
        const retime::RetimeOptions options{.rotation = rotation, .antialias = antialias};
        const Motion expected = retimed(smooth, map, options);
        const Motion found = retimed(jumping, map, options);
        for (std::size_t f = 0; f < found.clip.num_frames; ++f) {
          EXPECT_NEAR(wrapped(found.clip.row(f)[0] - expected.clip.row(f)[0]), 0, 1e-9);
        }
      }
    }
  }
}

TEST(RetimeTurns, AWheelThatTurnsOnAndOnIsAveragedAlongItsWay) {
  std::vector<double> angles;
  for (int f = 0; f < 100; ++f) angles.push_back(wrapped(100.0 * f));
  const Motion fast = retimed(wheel(angles), constant_rate(24, 4), {.antialias = true});
  for (std::size_t f = 4; f < 20; ++f) {
    EXPECT_NEAR(wrapped(fast.clip.row(f)[0] - 400.0 * static_cast<double>(f)), 0, 1e-9);
  }
}

TEST(RetimeTurns, GapsArePassedOver) {
  const Motion gap = wheel({170, kNaN, -170, 175});
  EXPECT_NEAR(retimed(gap, {{2.5}}).clip.row(0)[0], -177.5, 1e-12);
}

TEST(RetimeTurns, AMimicJointHasATurnOfItsOwn) {
  // The joint turns by half of its column's number: 720 bring it round once.
  Motion motion = wheel({0, 400, -300});
  motion.skeleton.joints[0].dofs[0].gain = 0.5;
  const Motion half = retimed(motion, {{0.5, 1.5}});
  EXPECT_NEAR(half.clip.row(0)[0], -160, 1e-12) << "from 0 to 400 - 720";
  EXPECT_NEAR(half.clip.row(1)[0], 410, 1e-12) << "from 400 to -300 + 720";
}

TEST(RetimeTurns, AColumnThatIsALengthTooIsAPlainNumber) {
  Motion motion = wheel({179, -172});
  Joint slider;
  slider.name = "slider";
  slider.parent = 0;
  slider.dofs = {motion.skeleton.joints[0].dofs[0]};
  slider.dofs[0].kind = DofKind::Translation;
  motion.skeleton.joints.push_back(slider);
  EXPECT_EQ(retimed(motion, {{0.5}}).clip.row(0)[0], 3.5);
}

TEST(RetimeTurns, SmoothAndBlendHaveTheSameRule) {
  // Exactly half a turn is no jump for any of them.
  const Motion flips = wheel({0, 180, 0, 180});
  EXPECT_EQ(edit::unwrap(flips).clip.values, flips.clip.values);
  const auto looped = edit::loop(wheel({0, 90, 180}), 2, 1, test::ignored());
  ASSERT_TRUE(looped);
  EXPECT_EQ(looped->clip.row(2)[0], 90);
}

}  // namespace
}  // namespace kinefile
