// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "kinefile/math.hpp"

namespace kinefile {
namespace {

Mat3 product(const EulerAxes& axes, const Vec3& angles) {
  return (Eigen::AngleAxisd(angles[0], axes[0]) * Eigen::AngleAxisd(angles[1], axes[1]) *
          Eigen::AngleAxisd(angles[2], axes[2]))
      .toRotationMatrix();
}

/// The twelve orders about x, y and z, and some about other axes.
std::vector<EulerAxes> all_axes() {
  std::vector<EulerAxes> all;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      for (int c = 0; c < 3; ++c) {
        if (a != b && b != c) all.push_back({Vec3::Unit(a), Vec3::Unit(b), Vec3::Unit(c)});
      }
    }
  }
  const Mat3 tilt = product(all[0], {0.3, -1.1, 2});
  for (std::size_t i = 0; i < 12; ++i) {
    all.push_back({tilt * all[i][0], -(tilt * all[i][1]), tilt * all[i][2]});
  }
  return all;
}

TEST(EulerAngles, FindsTheRotationAgainInEveryOrder) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> angle(-7, 7);
  for (const EulerAxes& axes : all_axes()) {
    for (int i = 0; i < 200; ++i) {
      const Vec3 angles(angle(random), angle(random), angle(random));
      const Mat3 rotation = product(axes, angles);
      EXPECT_LT((product(axes, euler_angles(rotation, axes)) - rotation).norm(), 1e-14);
    }
  }
}

TEST(EulerAngles, FindsTheTripleItself) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> angle(-20, 20);
  std::uniform_real_distribution<double> small(-0.05, 0.05);
  for (const EulerAxes& axes : all_axes()) {
    for (int i = 0; i < 200; ++i) {
      const Vec3 angles(angle(random), angle(random), angle(random));
      const Vec3 near = angles + Vec3(small(random), small(random), small(random));
      const Vec3 found = euler_angles(product(axes, angles), axes, near);
      // Close to gimbal lock the outer angles are hardly known, but the rotation is.
      EXPECT_LT((product(axes, found) - product(axes, angles)).norm(), 1e-13);
      EXPECT_LT((found - near).norm(), 0.5) << "far from where it was";
    }
  }
}

TEST(EulerAngles, KeepsTheFirstAngleInGimbalLock) {
  const double right = std::numbers::pi / 2;
  for (const EulerAxes& axes : all_axes()) {
    const bool is_proper = std::abs(axes[0].dot(axes[2])) > 0.5;
    for (const double middle : {right, -right, 0.0, 2 * right}) {
      const bool is_locked = is_proper == (middle == 0 || middle == 2 * right);
      if (!is_locked) continue;
      const Vec3 angles(0.4, middle, -1.3);
      const Mat3 rotation = product(axes, angles);
      const Vec3 found = euler_angles(rotation, axes, angles);
      EXPECT_LT((product(axes, found) - rotation).norm(), 1e-14);
      EXPECT_LT((found - angles).norm(), 1e-7);
    }
  }
}

TEST(EulerAngles, StaysExactCloseToGimbalLock) {
  const EulerAxes axes = {Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
  for (double gap = 1e-2; gap > 1e-17; gap /= 10) {
    const Mat3 rotation = product(axes, {0.3, std::numbers::pi / 2 - gap, 0.8});
    EXPECT_LT((product(axes, euler_angles(rotation, axes)) - rotation).norm(), 1e-12) << gap;
  }
}

TEST(CoordinateAxis, KnowsThreeVectors) {
  EXPECT_EQ(coordinate_axis(Vec3::UnitZ()), 2u);
  EXPECT_FALSE(coordinate_axis(-Vec3::UnitZ()));
  EXPECT_FALSE(coordinate_axis(Vec3(0, 0.6, 0.8)));
}

TEST(AngleBetween, IsTheShorterWayAround) {
  const Quat a(Eigen::AngleAxisd(0.2, Vec3::UnitY()));
  Quat b(Eigen::AngleAxisd(0.5, Vec3::UnitY()));
  EXPECT_NEAR(angle_between(a, b), 0.3, 1e-15);
  b.coeffs() = -b.coeffs();
  EXPECT_NEAR(angle_between(a, b), 0.3, 1e-15);
  EXPECT_EQ(angle_between(a, a), 0);
}

}  // namespace
}  // namespace kinefile
