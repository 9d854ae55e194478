// SPDX-License-Identifier: MIT
// Batches of rotations are held against the functions that find them one by one.
#include "rotation/rotations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kinefile/joint_rotation.hpp"
#include "kinematics/rotation_batches.hpp"
#include "support/motions.hpp"

namespace kinefile {
namespace {

using Random = std::mt19937_64;

constexpr std::size_t kNumFrames = 600;  // more than a batch

Vec3 random_axis(Random& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

/// A motion about three axes with walks of all step sizes, turns beyond a whole one, and gimbal
/// lock: the middle angle is often a multiple of a right angle.
Motion random_turning(Random& random, const EulerAxes& axes, AngleUnit unit) {
  std::uniform_real_distribution<double> step(-40, 40);
  std::vector<Vec3> rows;
  Vec3 angles(step(random), step(random), step(random));
  for (std::size_t f = 0; f < kNumFrames; ++f) {
    if (f % 7 == 0) angles = 30 * Vec3(step(random), step(random), step(random));
    angles += 0.5 * Vec3(step(random), step(random), step(random));
    Vec3 row = angles;
    if (f % 5 == 0) row[1] = 90 * std::round(row[1] / 90);
    rows.push_back(unit == AngleUnit::Degrees ? row : Vec3(row * kRadiansPerDegree));
  }
  return test::turning_motion(axes, rows, unit);
}

Mat3 matrix_at(const simd::Quaternions& q, std::size_t i) {
  return rotation::quaternion_at(q, i).toRotationMatrix();
}

double difference(const Mat3& a, const Mat3& b) { return angle_between(Quat(a), Quat(b)); }

TEST(RotationBatches, ProductsAreThoseOfTheRows) {
  Random random(1);
  for (const AngleUnit unit : {AngleUnit::Degrees, AngleUnit::Radians}) {
    for (std::size_t count = 0; count < 5; ++count) {
      Motion motion = random_turning(random, test::all_euler_axes()[count], unit);
      std::vector<DegreeOfFreedom> rotations;
      for (std::size_t k = 0; k < count; ++k) {
        rotations.push_back({DofKind::Rotation, random_axis(random), k % 3, 0});
      }
      simd::Quaternions found;
      for (const FrameBatch& frames : batches_of(kNumFrames)) {
        RotationReader(rotations, unit).read(motion.clip, frames, found);
        for (std::size_t i = 0; i < frames.count; ++i) {
          const auto row = motion.clip.row(frames.first + i);
          ASSERT_LT(difference(matrix_at(found, i), rotation_in_row(rotations, row, unit)), 1e-12);
          ASSERT_NEAR(rotation::quaternion_at(found, i).norm(), 1, 1e-14);
        }
      }
    }
  }
}

TEST(RotationBatches, TurnedAxesAreThoseOfTheMatrix) {
  Random random(2);
  for (int n = 0; n < 50; ++n) {
    const Mat3 turn = Eigen::AngleAxisd(n, random_axis(random)).toRotationMatrix();
    const Mat3 mirror = turn - 2 * (turn * Vec3::UnitX()) * Vec3::UnitX().transpose();
    const Mat3 old = Eigen::AngleAxisd(1 + n, random_axis(random)).toRotationMatrix();
    for (const Mat3& matrix : {turn, mirror}) {
      simd::Quaternions q;
      rotation::resize(q, 1);
      rotation::put_quaternion(Quat(old), 0, q);
      rotation::turn_axes(matrix * matrix.determinant(), q);
      EXPECT_LT(difference(matrix_at(q, 0), matrix * old * matrix.transpose()), 1e-14);
    }
  }
}

/// Fits the rotations of a motion to three other axes, in batches and one by one. The angles are
/// the same, but for rotations at the edge of gimbal lock, where the outer ones hardly matter.
void expect_same_angles(const Motion& from, const EulerAxes& axes, AngleUnit unit) {
  const auto rotations = rotations_of(from.skeleton.joints[0]);
  Motion found = test::turning_motion(axes, std::vector<Vec3>(kNumFrames, Vec3::Zero()), unit);
  const auto wanted = rotations_of(found.skeleton.joints[0]);
  const double per_radian = 1 / radians_per(unit);
  std::vector<double> near = {0.1, 0.2, 0.3};  // from which half a turn each way is not as far
  RotationFitter fitter(wanted, unit, near);
  simd::Quaternions q;
  const Rows rows = found.clip.mutate();
  for (const FrameBatch& frames : batches_of(kNumFrames)) {
    RotationReader(rotations, from.skeleton.angle_unit).read(from.clip, frames, q);
    const simd::Quaternions kept = q;
    EXPECT_EQ(fitter.fit(q, frames, rows), 0);
    for (std::size_t i = 0; i < frames.count; ++i) {
      const auto row = rows[frames.first + i];
      const Mat3 rotation = matrix_at(kept, i);
      std::vector<double> one(near);
      fit_rotation(wanted, rotation, unit, one);
      ASSERT_LT(difference(rotation_in_row(wanted, row, unit), rotation), 1e-12) << i;
      const double far = std::abs(axes[0].dot(axes[2])) > 0.5 ? std::sin(one[1] / per_radian)
                                                              : std::cos(one[1] / per_radian);
      const double size = 1 + Vec3(one[0], one[1], one[2]).norm() / per_radian;
      const bool is_locked = std::abs(far) < 1e-11;
      const double tolerance = 1e-12 * size * per_radian / (is_locked ? 1 : std::abs(far));
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_NEAR(row[k], one[k], tolerance) << i << " " << k << " " << far;
        near[k] = row[k];
      }
    }
  }
}

TEST(RotationBatches, AnglesAreThoseFoundOneByOne) {
  Random random(3);
  const auto all = test::all_euler_axes();
  for (std::size_t n = 0; n < all.size(); ++n) {
    const AngleUnit unit = n % 2 == 0 ? AngleUnit::Degrees : AngleUnit::Radians;
    expect_same_angles(random_turning(random, all[n], unit), all[n], unit);
    const EulerAxes& others = all[random() % all.size()];
    expect_same_angles(random_turning(random, others, unit), all[n], unit);
  }
}

TEST(RotationBatches, InGimbalLockTheFirstAngleStays) {
  for (const EulerAxes& axes : test::all_euler_axes()) {
    const bool is_proper = std::abs(axes[0].dot(axes[2])) > 0.5;
    std::vector<Vec3> rows;
    for (int f = 0; f < 20; ++f) rows.emplace_back(10 * f, is_proper ? 180 : -90, 3 * f);
    const Motion motion = test::turning_motion(axes, rows);
    const auto rotations = rotations_of(motion.skeleton.joints[0]);
    Motion found = motion;
    simd::Quaternions q;
    RotationReader(rotations, AngleUnit::Degrees).read(motion.clip, {0, 20}, q);
    RotationFitter fitter(rotations, AngleUnit::Degrees, motion.clip.row(3));
    fitter.fit(q, {0, 20}, found.clip.mutate());
    for (std::size_t f = 0; f < 20; ++f) {
      EXPECT_EQ(found.clip.row(f)[0], 30) << f;
      EXPECT_LT(difference(rotation_in_row(rotations, found.clip.row(f), AngleUnit::Degrees),
                           rotation_in_row(rotations, motion.clip.row(f), AngleUnit::Degrees)),
                1e-12);
    }
  }
}

TEST(RotationBatches, WhatIsNotFiniteTouchesNoOtherFrame) {
  const EulerAxes axes = test::all_euler_axes()[0];
  for (const double broken : {std::nan(""), HUGE_VAL}) {
    const Motion motion =
        test::turning_motion(axes, {{1, 2, 3}, {370, broken, 3}, {361, 362, 363}});
    const auto rotations = rotations_of(motion.skeleton.joints[0]);
    Motion found = motion;
    simd::Quaternions q;
    RotationReader(rotations, AngleUnit::Degrees).read(motion.clip, {0, 3}, q);
    RotationFitter fitter(rotations, AngleUnit::Degrees, motion.clip.row(0));
    fitter.fit(q, {0, 3}, found.clip.mutate());
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(found.clip.row(0)[k], motion.clip.row(0)[k], 1e-12);
      EXPECT_TRUE(std::isnan(found.clip.row(1)[k]));
      EXPECT_NEAR(found.clip.row(2)[k], motion.clip.row(0)[k], 1e-12);
    }
  }
}

TEST(RotationBatches, OtherJointsAreFittedAsOneByOne) {
  Random random(4);
  const Motion motion = random_turning(random, test::all_euler_axes()[0], AngleUnit::Degrees);
  const auto rotations = rotations_of(motion.skeleton.joints[0]);
  const std::vector<DegreeOfFreedom> two = {{DofKind::Rotation, random_axis(random), 2, 0},
                                            {DofKind::Rotation, random_axis(random), 0, 0}};
  Motion found = motion;
  std::vector<double> near(3, 0);
  RotationFitter fitter(two, AngleUnit::Degrees, near);
  simd::Quaternions q;
  RotationReader(rotations, AngleUnit::Degrees).read(motion.clip, {0, 40}, q);
  const double residual = fitter.fit(q, {0, 40}, found.clip.mutate());
  double largest = 0;
  for (std::size_t f = 0; f < 40; ++f) {
    largest = std::max(largest, fit_rotation(two, matrix_at(q, f), AngleUnit::Degrees, near));
    EXPECT_EQ(found.clip.row(f)[0], near[0]);
    EXPECT_EQ(found.clip.row(f)[2], near[2]);
    EXPECT_EQ(found.clip.row(f)[1], motion.clip.row(f)[1]);
  }
  EXPECT_EQ(residual, largest);
}

TEST(FitRotation, ObliqueAxesGoTheShortWay) {
  // Axes of a robot's shoulder, 16 degrees off: near a singular pose steps are long.
  std::vector<DegreeOfFreedom> rotations = {{DofKind::Rotation, Vec3::UnitY(), 0, 0},
                                            {DofKind::Rotation, Vec3(0.96, 0, 0.28), 1, 0},
                                            {DofKind::Rotation, Vec3::UnitY(), 2, 0}};
  const double pi = std::acos(-1.0);
  for (int k = 0; k < 200; ++k) {
    const double t = 0.1 * k;
    const Quat target = Quat(Eigen::AngleAxisd(1.5 * std::sin(t), Vec3::UnitY())) *
                        Quat(Eigen::AngleAxisd(0.02 * std::cos(3 * t), Vec3(0.96, 0, 0.28))) *
                        Quat(Eigen::AngleAxisd(1.4 * std::cos(t), Vec3::UnitY()));
    std::vector<double> row = {0, 0, 0};
    const double residual =
        fit_rotation(rotations, target.toRotationMatrix(), AngleUnit::Radians, row);
    EXPECT_LT(residual, 1e-6) << k;
    for (const double angle : row) EXPECT_LE(std::abs(angle), pi) << k;
  }
}

}  // namespace
}  // namespace kinefile
