// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kinefile/kinematics.hpp"

namespace kinefile {
namespace {

using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3 random_vector(Random& random) {
  return {uniform(random, -2, 2), uniform(random, -2, 2), uniform(random, -2, 2)};
}

Vec3 random_unit_axis(Random& random) {
  return random() % 2 == 0 ? Vec3(Vec3::Unit(static_cast<Eigen::Index>(random() % 3)))
                           : Vec3(random_vector(random).normalized());
}

/// A column for a new degree of freedom: a new one, or one that is there and read as a number.
std::size_t random_column(Random& random, Skeleton& skeleton, std::size_t joint,
                          std::vector<std::size_t>& shared) {
  if (!shared.empty() && random() % 4 == 0) return shared[random() % shared.size()];
  skeleton.coordinates.push_back({joint, "c"});
  shared.push_back(skeleton.coordinates.size() - 1);
  return shared.back();
}

/// A degree of freedom, some of them with a gain and a shift.
DegreeOfFreedom random_dof(Random& random, DofKind kind, std::size_t column) {
  DegreeOfFreedom dof{kind, random_unit_axis(random), column, 0};
  if (random() % 4 != 0) return dof;
  dof.gain = uniform(random, -2, 2);
  dof.shift = uniform(random, -1, 1);
  return dof;
}

/// Adds a ball or a rotation vector. Returns false for a joint that gets none.
bool add_whole_rotation(Random& random, Skeleton& skeleton, std::size_t j, Joint& joint) {
  if (random() % 3 != 0) return false;
  const DofKind kind = random() % 2 == 0 ? DofKind::Ball : DofKind::RotationVector;
  joint.dofs.push_back({kind, Vec3::UnitX(), skeleton.coordinates.size(), 0});
  for (std::size_t k = 0; k < num_coordinates(joint.dofs.back()); ++k) {
    skeleton.coordinates.push_back({j, channel_name(kind, k)});
  }
  return true;
}

/// A tree with everything that a skeleton may have: free joints, balls, rotation vectors, rest
/// rotations, oblique axes, tails, shared columns, gains and shifts, several roots, tips.
Skeleton random_skeleton(Random& random) {
  Skeleton skeleton;
  skeleton.angle_unit = random() % 2 == 0 ? AngleUnit::Degrees : AngleUnit::Radians;
  std::vector<std::size_t> shared;
  const std::size_t num_joints = 1 + random() % 7;
  for (std::size_t j = 0; j < num_joints; ++j) {
    Joint joint;
    joint.name = "j" + std::to_string(j);
    joint.parent = j == 0 || random() % 8 == 0 ? kNoParent : random() % j;
    joint.offset = random_vector(random);
    if (random() % 2 == 0) {
      joint.rest_rotation =
          Quat(Eigen::AngleAxisd(uniform(random, 0, 3), random_unit_axis(random)));
    }
    if (random() % 4 == 0) {
      joint.dofs = {{DofKind::Free, Vec3::UnitX(), skeleton.coordinates.size(), 0}};
      for (int k = 0; k < 7; ++k) skeleton.coordinates.push_back({j, "f"});
    } else {
      const std::array<DofKind, 4> kinds = {DofKind::Translation, DofKind::Rotation,
                                            DofKind::TailTranslation, DofKind::TailScale};
      const bool is_whole = add_whole_rotation(random, skeleton, j, joint);
      for (const DofKind kind : kinds) {
        if (is_whole && kind == DofKind::Translation) continue;
        if (is_whole && kind == DofKind::Rotation) continue;
        for (std::size_t n = random() % 4; n > 0; --n) {
          const std::size_t column = random_column(random, skeleton, j, shared);
          joint.dofs.push_back(random_dof(random, kind, column));
        }
      }
    }
    for (std::size_t t = random() % 3; t > 0; --t)
      joint.tips.push_back({"", random_vector(random)});
    skeleton.joints.push_back(std::move(joint));
  }
  return skeleton;
}

/// Values of which no quaternion has length 1.
std::vector<double> random_row(Random& random, const Skeleton& skeleton) {
  std::vector<double> row;
  for (std::size_t c = 0; c < skeleton.coordinates.size(); ++c) {
    row.push_back(uniform(random, -2, 2));
  }
  return row;
}

Clip clip_of(const std::vector<double>& values, std::size_t num_coordinates) {
  Clip clip;
  clip.num_coordinates = num_coordinates;
  clip.num_frames = 1;
  clip.values = values;
  return clip;
}

/// All points of interest of a skeleton: of each joint one in its frame, and its tips.
std::vector<JointPoint> random_points(Random& random, const Skeleton& skeleton) {
  std::vector<JointPoint> points;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    points.push_back({j, random_vector(random), false});
    for (const Tip& tip : skeleton.joints[j].tips) points.push_back({j, tip.offset, true});
  }
  return points;
}

Vec3 position_at(const Kinematics& kinematics, const JointPoint& point,
                 const std::vector<double>& row) {
  std::vector<JointFrame> frames(kinematics.num_joints());
  kinematics.place_row(row, frames);
  return kinematics.position_of(point, row, frames);
}

TEST(Kinematics, OneRowIsPlacedAsManyAre) {
  Random random(21);
  for (int n = 0; n < 100; ++n) {
    const Skeleton skeleton = random_skeleton(random);
    ASSERT_TRUE(validate(skeleton));
    const auto row = random_row(random, skeleton);
    const WorldPoses poses =
        forward_kinematics(skeleton, clip_of(row, row.size()), {.rotations = true, .tips = true});
    const Kinematics kinematics(skeleton);
    ASSERT_EQ(kinematics.num_coordinates(), row.size());
    ASSERT_EQ(kinematics.num_tips(), poses.num_tips);
    std::vector<JointFrame> frames(kinematics.num_joints());
    kinematics.place_row(row, frames);
    std::size_t tip_index = 0;
    for (std::size_t j = 0; j < frames.size(); ++j) {
      const double size = 1 + frames[j].position.norm();
      EXPECT_LT((frames[j].position - Vec3(&poses.positions[3 * j])).norm(), 1e-12 * size);
      const double* q = &poses.rotations[4 * j];
      EXPECT_LT(angle_between(Quat(frames[j].rotation), Quat(q[0], q[1], q[2], q[3])), 1e-12);
      for (const Tip& tip : skeleton.joints[j].tips) {
        const Vec3 found = kinematics.position_of({j, tip.offset, true}, row, frames);
        EXPECT_LT((found - Vec3(&poses.tips[3 * tip_index++])).norm(), 1e-11 * size);
      }
    }
  }
}

TEST(Kinematics, TheJacobianIsTheDerivative) {
  Random random(22);
  constexpr double kStep = 1e-5;
  std::size_t num_columns = 0;
  for (int n = 0; n < 80; ++n) {
    const Skeleton skeleton = random_skeleton(random);
    const auto row = random_row(random, skeleton);
    const Kinematics kinematics(skeleton);
    std::vector<JointFrame> frames(kinematics.num_joints());
    kinematics.place_row(row, frames);
    std::vector<double> jacobian(3 * row.size(), 7.0);
    for (const JointPoint& point : random_points(random, skeleton)) {
      kinematics.jacobian(point, row, frames, jacobian);
      for (std::size_t c = 0; c < row.size(); ++c) {
        std::vector<double> before = row;
        std::vector<double> after = row;
        before[c] -= kStep;
        after[c] += kStep;
        const Vec3 a = position_at(kinematics, point, before);
        const Vec3 b = position_at(kinematics, point, after);
        const Vec3 expected = (b - a) / (2 * kStep);
        const Vec3 found(&jacobian[3 * c]);
        ASSERT_LT((found - expected).norm(), 1e-6 * (1 + a.norm() + expected.norm()))
            << n << " " << c << " of joint " << point.joint;
        ++num_columns;
      }
    }
  }
  EXPECT_GT(num_columns, 5000u);
}

TEST(Kinematics, ARotationVectorTurnsAboutItself) {
  Random random(25);
  for (const AngleUnit unit : {AngleUnit::Degrees, AngleUnit::Radians}) {
    Skeleton skeleton;
    skeleton.angle_unit = unit;
    skeleton.joints.resize(1);
    skeleton.joints[0].dofs = {{DofKind::RotationVector, Vec3::UnitX(), 0, 0}};
    for (int k = 0; k < 3; ++k) skeleton.coordinates.push_back({0, "v"});
    ASSERT_TRUE(validate(skeleton));
    for (const double size : {0.0, 1e-300, 1e-9, 1e-5, 1.0, 3.0, 40.0}) {
      const Vec3 vector = size / radians_per(unit) * random_vector(random);
      const double angle = vector.norm() * radians_per(unit);
      const Mat3 expected =
          Eigen::AngleAxisd(angle, vector.norm() > 0 ? Vec3(vector.normalized()) : Vec3::UnitX())
              .toRotationMatrix();
      const std::vector<double> row = {vector[0], vector[1], vector[2]};
      const WorldPoses poses = forward_kinematics(skeleton, clip_of(row, 3), {.rotations = true});
      const double* q = poses.rotations.data();
      EXPECT_LT((Quat(q[0], q[1], q[2], q[3]).toRotationMatrix() - expected).norm(), 2e-14) << size;
      std::vector<JointFrame> frames(1);
      Kinematics(skeleton).place_row(row, frames);
      EXPECT_LT((frames[0].rotation - expected).norm(), 2e-14) << size;
    }
  }
}

TEST(Kinematics, AQuaternionHasNoDerivativeAlongItself) {
  Random random(23);
  Skeleton skeleton;
  skeleton.joints.resize(1);
  skeleton.joints[0].dofs = {{DofKind::Free, Vec3::UnitX(), 0, 0}};
  for (int k = 0; k < 7; ++k) skeleton.coordinates.push_back({0, "f"});
  const Kinematics kinematics(skeleton);
  const auto row = random_row(random, skeleton);
  std::vector<JointFrame> frames(1);
  kinematics.place_row(row, frames);
  std::vector<double> numbers(21);
  kinematics.jacobian({0, Vec3(1, 2, 3)}, row, frames, numbers);
  const Eigen::Map<const Eigen::Matrix3Xd> jacobian(numbers.data(), 3, 7);
  const Eigen::Map<const Eigen::Vector4d> q(&row[3]);
  EXPECT_LT((jacobian.rightCols(4) * q).norm(), 1e-13);
  EXPECT_GT(jacobian.rightCols(4).norm(), 1);
  EXPECT_EQ(Mat3(jacobian.leftCols(3)), Mat3(Mat3::Identity()));
}

TEST(Kinematics, PlacesIntoTheCallersMemoryAsOftenAsWanted) {
  Random random(24);
  const Skeleton skeleton = random_skeleton(random);
  const Kinematics kinematics(skeleton);
  const std::size_t num_joints = kinematics.num_joints();
  std::vector<double> positions(2 * 3 * num_joints);
  for (int n = 0; n < 3; ++n) {
    const auto first = random_row(random, skeleton);
    const auto second = random_row(random, skeleton);
    std::vector<double> rows = first;
    rows.push_back(99);  // rows may lie further apart than they are wide
    rows.insert(rows.end(), second.begin(), second.end());
    const ValueRows values{rows, 2, first.size() + 1};
    kinematics.place(values, {positions, {}, {}, {}});
    const auto one = forward_kinematics(skeleton, clip_of(first, first.size()));
    const auto two = forward_kinematics(skeleton, clip_of(second, second.size()));
    for (std::size_t i = 0; i < 3 * num_joints; ++i) {
      EXPECT_EQ(positions[i], one.positions[i]);
      EXPECT_EQ(positions[3 * num_joints + i], two.positions[i]);
    }
    kinematics.place_locally(values, {positions, {}, {}, {}});
    const auto local = local_poses(skeleton, clip_of(first, first.size()));
    for (std::size_t i = 0; i < 3 * num_joints; ++i) EXPECT_EQ(positions[i], local.positions[i]);
  }
}

}  // namespace
}  // namespace kinefile
