// SPDX-License-Identifier: MIT
// Compares the kernel with the functions of math.hpp, for every set of axes.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kinefile/joint_rotation.hpp"
#include "support/motions.hpp"

namespace kinefile {
namespace {

using test::all_euler_axes;
using test::retimed;
using test::turning_motion;

/// The angles of a joint in a row, in radians.
Vec3 angles_in(std::span<const double> row, AngleUnit unit) {
  const double radians = unit == AngleUnit::Degrees ? kRadiansPerDegree : 1.0;
  return radians * Vec3(row[0], row[1], row[2]);
}

Mat3 euler_product(const EulerAxes& axes, const Vec3& angles) {
  return (Eigen::AngleAxisd(angles[0], axes[0]) * Eigen::AngleAxisd(angles[1], axes[1]) *
          Eigen::AngleAxisd(angles[2], axes[2]))
      .toRotationMatrix();
}

/// How far from gimbal lock angles are: 0 in it, 1 at most.
double distance_from_lock(const EulerAxes& axes, double middle) {
  const bool is_proper = std::abs(axes[0].dot(axes[2])) > 0.5;
  return std::abs(is_proper ? std::sin(middle) : std::cos(middle));
}

using Interpolate = Quat (*)(const Quat&, const Quat&, double);

/// A new row must make the rotation that math.hpp gives, with the angles that it gives.
void expect_row(const Motion& old, const Vec3& found, std::size_t frame, double t,
                Interpolate interpolate) {
  const AngleUnit unit = old.skeleton.angle_unit;
  const auto rotations = rotations_of(old.skeleton.joints[0]);
  const EulerAxes axes = *euler_axes_of(rotations);
  const Vec3 from = angles_in(old.clip.row(frame), unit);
  const Vec3 to = angles_in(old.clip.row(frame + 1), unit);
  const Quat a(rotation_in_row(rotations, old.clip.row(frame), unit));
  const Quat b(rotation_in_row(rotations, old.clip.row(frame + 1), unit));
  if (std::abs(a.dot(b)) < 1e-3) return;  // two ways that are as short
  const Quat expected = interpolate(a, b, t);
  const Vec3 near = from + t * (to - from);
  EXPECT_LT((euler_product(axes, found) - expected.toRotationMatrix()).norm(), 3e-13);
  const Vec3 angles = euler_angles(expected.toRotationMatrix(), axes, near);
  // Where two triples are as near, either may be taken.
  EXPECT_NEAR((found - near).norm(), (angles - near).norm(), 1e-4);
  const double lock = distance_from_lock(axes, angles[1]);
  if (lock < 0.05 || (found - near).norm() > 1.5) return;
  EXPECT_LT((found - angles).norm(), 1e-12);
}

void expect_agreement(AngleUnit unit, double most, retime::RotationInterpolation rotation,
                      Interpolate interpolate) {
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> angle(-most, most);
  std::uniform_real_distribution<double> step(-most / 10, most / 10);
  for (const EulerAxes& axes : all_euler_axes()) {
    std::vector<Vec3> rows;
    retime::TimeMap map;
    std::uniform_real_distribution<double> t(0, 1);
    for (std::size_t f = 0; f < 300; ++f) {
      const Vec3 start(angle(random), angle(random), angle(random));
      rows.push_back(start);
      rows.push_back(start + Vec3(step(random), step(random), step(random)));
      map.old_frames.push_back(static_cast<double>(2 * f) + t(random));
    }
    const Motion old = turning_motion(axes, rows, unit);
    const Motion found = retimed(old, map, {.rotation = rotation});
    for (std::size_t n = 0; n < 300; ++n) {
      const double whole = std::floor(map.old_frames[n]);
      expect_row(old, angles_in(found.clip.row(n), unit), static_cast<std::size_t>(whole),
                 map.old_frames[n] - whole, interpolate);
    }
  }
}

TEST(RetimeRotations, SlerpIsThatOfTheMathematicsInDegrees) {
  expect_agreement(AngleUnit::Degrees, 400, retime::RotationInterpolation::Slerp, slerp);
}

TEST(RetimeRotations, SlerpIsThatOfTheMathematicsInRadians) {
  expect_agreement(AngleUnit::Radians, 7, retime::RotationInterpolation::Slerp, slerp);
}

TEST(RetimeRotations, SlerpOfSmallStepsIsThatOfTheMathematics) {
  expect_agreement(AngleUnit::Radians, 1e-7, retime::RotationInterpolation::Slerp, slerp);
  expect_agreement(AngleUnit::Degrees, 1e-3, retime::RotationInterpolation::Slerp, slerp);
}

TEST(RetimeRotations, NlerpIsThatOfTheMathematics) {
  expect_agreement(AngleUnit::Degrees, 400, retime::RotationInterpolation::Nlerp, nlerp);
}

TEST(RetimeRotations, EqualRowsGiveTheSameAngles) {
  std::mt19937_64 random(22);
  std::uniform_real_distribution<double> angle(-1000, 1000);
  for (const EulerAxes& axes : all_euler_axes()) {
    for (int i = 0; i < 50; ++i) {
      const Vec3 row(angle(random), angle(random), angle(random));
      for (const auto rotation :
           {retime::RotationInterpolation::Slerp, retime::RotationInterpolation::Cubic}) {
        const Motion same =
            retimed(turning_motion(axes, {row, row, row}), {{0.3, 1.7}}, {.rotation = rotation});
        const double lock = distance_from_lock(axes, row[1] * kRadiansPerDegree);
        for (std::size_t c = 0; c < 6; ++c) {
          EXPECT_NEAR(same.clip.values[c], row[static_cast<Eigen::Index>(c % 3)],
                      1e-12 + 1e-13 / lock);
        }
      }
    }
  }
}

TEST(RetimeRotations, OppositeTwinsAreTheSameRotation) {
  // A turn of 360 degrees about the first axis gives the opposite quaternion.
  for (const EulerAxes& axes : all_euler_axes()) {
    const Motion motion = turning_motion(axes, {{10, 50, 30}, {370, 50, 30}, {10, 50, 30}});
    const Motion same = retimed(motion, {{0.25, 1.75}});
    for (std::size_t n = 0; n < 2; ++n) {
      const auto row = same.clip.row(n);
      EXPECT_NEAR(row[0], 10, 1e-11);
      EXPECT_NEAR(row[1], 50, 1e-11);
      EXPECT_NEAR(row[2], 30, 1e-11);
    }
  }
}

TEST(RetimeRotations, InGimbalLockTheAnglesGoStraight) {
  for (const EulerAxes& axes : all_euler_axes()) {
    const bool is_proper = std::abs(axes[0].dot(axes[2])) > 0.5;
    for (const double middle : {0.0, 90.0, -90.0, 180.0, 270.0}) {
      if (is_proper != (middle == 0 || middle == 180)) continue;
      const Motion motion = turning_motion(axes, {{10, middle, 25}, {16, middle, 35}});
      const Motion half = retimed(motion, {{0.5}});
      EXPECT_NEAR(half.clip.row(0)[0], 13, 1e-10) << middle;
      EXPECT_NEAR(half.clip.row(0)[1], middle, 1e-10);
      EXPECT_NEAR(half.clip.row(0)[2], 30, 1e-10);
    }
  }
}

TEST(RetimeRotations, CloseToGimbalLockTheRotationIsExact) {
  for (const EulerAxes& axes : all_euler_axes()) {
    const bool is_proper = std::abs(axes[0].dot(axes[2])) > 0.5;
    for (double gap = 1e-2; gap > 1e-17; gap /= 10) {
      const double middle = is_proper ? gap : std::numbers::pi / 2 - gap;
      const Vec3 from(0.3, middle, 0.8);
      const Vec3 to(0.4, middle, 0.5);
      const Motion motion = turning_motion(axes, {from, to}, AngleUnit::Radians);
      const Motion half = retimed(motion, {{0.5}});
      const Quat expected =
          slerp(Quat(euler_product(axes, from)), Quat(euler_product(axes, to)), 0.5);
      const Vec3 found = angles_in(half.clip.row(0), AngleUnit::Radians);
      EXPECT_LT((euler_product(axes, found) - expected.toRotationMatrix()).norm(), 1e-12) << gap;
    }
  }
}

TEST(RetimeRotations, NoJumpThatTheOldMotionDoesNotHave) {
  // A spin, a curve that passes close to gimbal lock, and angles beyond it.
  for (const EulerAxes& axes : all_euler_axes()) {
    std::vector<Vec3> rows;
    for (int f = 0; f < 200; ++f) {
      const double x = 0.11 * f;
      rows.emplace_back(170 * std::sin(x) + 25 * f, 130 * std::sin(0.7 * x), -300 * std::cos(x));
    }
    const Motion motion = turning_motion(axes, rows);
    const double before = test::largest_step(motion.clip);
    ASSERT_LT(before, 180);
    for (const auto rotation :
         {retime::RotationInterpolation::Slerp, retime::RotationInterpolation::Nlerp,
          retime::RotationInterpolation::Cubic}) {
      const Motion slow = retimed(motion, test::constant_rate(1590, 0.125), {.rotation = rotation});
      EXPECT_LT(test::largest_step(slow.clip), 180);
    }
  }
}

TEST(RetimeRotations, CubicIsTheSquadOfTheMathematics) {
  for (const EulerAxes& axes : all_euler_axes()) {
    std::vector<Vec3> rows;
    for (int f = 0; f < 8; ++f) {
      rows.emplace_back(0.3 * f + 0.1 * f * f, 0.5 + 0.2 * std::sin(f), std::cos(0.8 * f));
    }
    const Motion motion = turning_motion(axes, rows, AngleUnit::Radians);
    const Motion found =
        retimed(motion, {{3.3, 0.5, 6.5}}, {.rotation = retime::RotationInterpolation::Cubic});
    const auto old = [&](std::size_t f, const Quat& near) {
      return on_side_of(Quat(euler_product(axes, rows[f])), near);
    };
    const auto expect = [&](std::size_t n, const Quat& expected) {
      const Mat3 rotation = euler_product(axes, angles_in(found.clip.row(n), AngleUnit::Radians));
      EXPECT_LT((rotation - expected.toRotationMatrix()).norm(), 1e-13);
    };
    const Quat a = old(3, Quat::Identity());
    const Quat b = old(4, a);
    expect(0, squad(a, squad_control(old(2, a), a, b), squad_control(a, b, old(5, b)), b, 0.3));
    const Quat first = old(0, Quat::Identity());
    const Quat second = old(1, first);
    expect(1, squad(first, first, squad_control(first, second, old(2, second)), second, 0.5));
    const Quat last = old(7, old(6, Quat::Identity()));
    const Quat one_before = old(6, last);
    expect(2,
           squad(one_before, squad_control(old(5, one_before), one_before, last), last, last, 0.5));
  }
}

TEST(RetimeRotations, ManyJointsAndFramesAreNotMixedUp) {
  // More frames than a batch, a map that goes back and forth: frame by frame gives the same bits.
  std::vector<Vec3> rows;
  for (int f = 0; f < 900; ++f) rows.emplace_back(f % 70, 0.1 * f - 45, 3 * f);
  const Motion motion = turning_motion(all_euler_axes()[4], rows);
  retime::TimeMap map;
  for (int n = 0; n < 1000; ++n) map.old_frames.push_back(450 + 449 * std::sin(0.37 * n));
  const Motion all = retimed(motion, map);
  for (std::size_t n = 0; n < 1000; n += 7) {
    const Motion one = retimed(motion, {{map.old_frames[n]}});
    EXPECT_TRUE(
        std::equal(one.clip.values.begin(), one.clip.values.end(), &all.clip.values[3 * n]));
  }
}

}  // namespace
}  // namespace kinefile
