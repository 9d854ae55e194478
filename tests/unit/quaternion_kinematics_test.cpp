// SPDX-License-Identifier: MIT
// The kernel of quaternions, held against the poses of single rows.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <random>
#include <vector>

#include "kinefile/kinematics.hpp"
#include "support/threads.hpp"

namespace kinefile {
namespace {

/// A tree of joints with every movement but whole rotations.
Skeleton make_tree(AngleUnit unit, std::size_t num_joints) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&] { return Vec3(number(random), number(random), number(random)); };
  Skeleton skeleton;
  skeleton.angle_unit = unit;
  for (std::size_t j = 0; j < num_joints; ++j) {
    Joint& joint = skeleton.joints.emplace_back();
    joint.name = "j" + std::to_string(j);
    joint.parent = j == 0 ? kNoParent : (j % 5 == 4 ? j - 3 : j - 1);
    joint.offset = vector();
    if (j % 4 == 1) joint.rest_rotation = Quat(Eigen::AngleAxisd(1.1, vector().normalized()));
    if (j % 6 == 2) joint.tips.push_back({"", vector()});
    const auto add = [&](DofKind kind, const Vec3& axis) {
      joint.dofs.push_back({kind, axis, skeleton.coordinates.size(), 0});
      skeleton.coordinates.push_back({j, "q"});
    };
    for (int k = 0; k < 3 && j % 7 == 0; ++k) add(DofKind::Translation, Vec3::Unit(k));
    for (int k = 0; k < 3; ++k) {
      const Vec3 axis = j % 3 == 2 ? Vec3(vector().normalized()) : Vec3(Vec3::Unit((k + 2) % 3));
      add(DofKind::Rotation, j % 8 == 3 ? Vec3(-axis) : axis);
    }
    if (j % 5 == 0) add(DofKind::TailScale, Vec3::UnitY());
    if (j % 5 == 1) add(DofKind::TailTranslation, Vec3::UnitX());
    if (j % 5 == 2) {
      joint.dofs.back().gain = -0.5;
      joint.dofs.back().shift = 0.3;
    }
  }
  return skeleton;
}

Clip make_clip(const Skeleton& skeleton, std::size_t num_frames, double most) {
  std::mt19937 random(18);
  std::uniform_real_distribution<double> value(-most, most);
  Clip clip;
  clip.num_coordinates = skeleton.coordinates.size();
  clip.num_frames = num_frames;
  std::vector<double> values(num_frames * clip.num_coordinates);
  for (double& number : values) number = value(random);
  clip.values = std::move(values);
  return clip;
}

constexpr KinematicsOptions kAll = {.rotations = true, .directions = true, .tips = true};

/// The largest difference of positions and of rotations from those of single rows, relative.
double difference_from_rows(const Skeleton& skeleton, const Clip& clip) {
  const WorldPoses poses = forward_kinematics(skeleton, clip, kAll);
  const Kinematics kinematics(skeleton);
  std::vector<JointFrame> frames(skeleton.joints.size());
  double largest = 0;
  double size = 1;
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    kinematics.place_row(clip.row(f), frames);
    for (std::size_t j = 0; j < frames.size(); ++j) {
      const std::size_t at = f * frames.size() + j;
      const double* p = &poses.positions[at * 3];
      const double* q = &poses.rotations[at * 4];
      size = std::max(size, frames[j].position.norm());
      largest = std::max(largest, (Vec3(p[0], p[1], p[2]) - frames[j].position).norm());
      const Mat3 rotation = Quat(q[0], q[1], q[2], q[3]).toRotationMatrix();
      largest = std::max(largest, (rotation - frames[j].rotation).norm());
    }
  }
  return largest / size;
}

TEST(QuaternionKinematics, AgreesWithTheRowsOneByOne) {
  for (const AngleUnit unit : {AngleUnit::Degrees, AngleUnit::Radians}) {
    const Skeleton skeleton = make_tree(unit, 23);
    ASSERT_TRUE(validate(skeleton));
    const double turn = unit == AngleUnit::Degrees ? 360 : 2 * std::numbers::pi;
    EXPECT_LT(difference_from_rows(skeleton, make_clip(skeleton, 53, turn)), 2e-14);
  }
}

TEST(QuaternionKinematics, FarAnglesAreReducedExactly) {
  Skeleton skeleton;
  skeleton.joints.resize(2);
  skeleton.joints[1].parent = 0;
  skeleton.joints[1].offset = Vec3(1, 0, 0);
  skeleton.joints[0].dofs = {{DofKind::Rotation, Vec3::UnitZ(), 0, 0}};
  skeleton.coordinates = {{0, "q"}};
  Clip clip;
  clip.num_coordinates = 1;
  clip.num_frames = 4;
  clip.values = std::vector<double>{30, 360e9 + 30, NAN, -360.0 * (1 << 20) + 30};
  const WorldPoses poses = forward_kinematics(skeleton, clip, kAll);
  for (const std::size_t f : {0u, 1u, 3u}) {
    EXPECT_NEAR(poses.positions[f * 6 + 3], std::sqrt(0.75), 1e-15) << f;
    EXPECT_NEAR(poses.positions[f * 6 + 4], 0.5, 1e-15) << f;
  }
  EXPECT_TRUE(std::isnan(poses.positions[2 * 6 + 3]));
}

/// Poses in single precision.
struct FloatPoses {
  std::vector<float> positions, rotations, directions, tips;
};

FloatPoses place_floats(const Skeleton& skeleton, const Clip& clip) {
  const Kinematics kinematics(skeleton);
  const std::size_t num_poses = clip.num_frames * kinematics.num_joints();
  FloatPoses poses;
  poses.positions.resize(num_poses * 3);
  poses.rotations.resize(num_poses * 4);
  poses.directions.resize(num_poses * 3);
  poses.tips.resize(clip.num_frames * kinematics.num_tips() * 3);
  kinematics.place({clip.values, clip.num_frames, clip.num_coordinates},
                   FloatPoseSpans{poses.positions, poses.rotations, poses.directions, poses.tips});
  return poses;
}

void expect_near(const std::vector<float>& found, std::span<const double> expected) {
  ASSERT_EQ(found.size(), expected.size());
  double size = 1;
  double difference = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    size = std::max(size, std::abs(expected[i]));
    difference = std::max(difference, std::abs(static_cast<double>(found[i]) - expected[i]));
  }
  EXPECT_LT(difference, 1e-5 * size);
}

TEST(QuaternionKinematics, SinglePrecisionIsNearToDouble) {
  for (const double turns : {1.0, 1000.0}) {
    const Skeleton skeleton = make_tree(AngleUnit::Degrees, 23);
    Clip clip = make_clip(skeleton, 37, 1);
    std::vector<double> values(clip.values.begin(), clip.values.end());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Coordinate& column = skeleton.coordinates[i % clip.num_coordinates];
      const Joint& joint = skeleton.joints[column.joint];
      for (const DegreeOfFreedom& dof : joint.dofs) {
        const bool is_angle = dof.kind == DofKind::Rotation;
        if (is_angle && dof.coordinate == i % clip.num_coordinates) values[i] *= 360 * turns;
      }
    }
    clip.values = std::move(values);
    const WorldPoses poses = forward_kinematics(skeleton, clip, kAll);
    const FloatPoses floats = place_floats(skeleton, clip);
    expect_near(floats.positions, poses.positions);
    expect_near(floats.directions, poses.directions);
    expect_near(floats.tips, poses.tips);
  }
}

TEST(QuaternionKinematics, EveryInstructionSetGivesTheSameBits) {
  const Skeleton skeleton = make_tree(AngleUnit::Degrees, 23);
  const Clip clip = make_clip(skeleton, 45, 500);
  const WorldPoses best = forward_kinematics(skeleton, clip, kAll);
  const FloatPoses best_floats = place_floats(skeleton, clip);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    const WorldPoses poses = forward_kinematics(skeleton, clip, kAll);
    const FloatPoses floats = place_floats(skeleton, clip);
    hwy::SetSupportedTargetsForTest(0);
    EXPECT_EQ(poses.positions, best.positions) << hwy::TargetName(target);
    EXPECT_EQ(poses.rotations, best.rotations) << hwy::TargetName(target);
    EXPECT_EQ(poses.directions, best.directions) << hwy::TargetName(target);
    EXPECT_EQ(poses.tips, best.tips) << hwy::TargetName(target);
    EXPECT_EQ(floats.positions, best_floats.positions) << hwy::TargetName(target);
    EXPECT_EQ(floats.rotations, best_floats.rotations) << hwy::TargetName(target);
  }
}

TEST(QuaternionKinematics, LargeResultsAreThoseOfTheirParts) {
  const Skeleton skeleton = make_tree(AngleUnit::Degrees, 23);
  const Clip clip = make_clip(skeleton, 16'003, 500);  // positions are 8.8 MB
  const Kinematics kinematics(skeleton);
  const std::size_t row_size = skeleton.joints.size() * 3;
  std::vector<double> memory(clip.num_frames * row_size + 1);
  const std::span<double> whole = std::span(memory).subspan(1);  // no cache line's beginning
  const std::span<const double> values = clip.values;
  for (const std::size_t threads : test::kThreadCounts) {
    const test::Threads some(threads);
    kinematics.place({values, clip.num_frames, clip.num_coordinates}, PoseSpans{whole});
    std::vector<double> part(100 * row_size);
    for (std::size_t first = 0; first + 100 <= clip.num_frames; first += 100) {
      kinematics.place({values.subspan(first * clip.num_coordinates), 100, clip.num_coordinates},
                       PoseSpans{part});
      const auto same = whole.subspan(first * row_size, part.size());
      ASSERT_TRUE(std::equal(part.begin(), part.end(), same.begin())) << first;
    }
  }
}

TEST(QuaternionKinematics, EveryNumberOfThreadsGivesTheSameBits) {
  const Skeleton skeleton = make_tree(AngleUnit::Degrees, 23);
  const Clip clip = make_clip(skeleton, 5'001, 500);
  const auto placed = [&](std::size_t threads) {
    const test::Threads some(threads);
    return forward_kinematics(skeleton, clip, kAll);
  };
  const WorldPoses alone = placed(1);
  for (const std::size_t threads : test::kThreadCounts) {
    const WorldPoses poses = placed(threads);
    EXPECT_EQ(poses.positions, alone.positions);
    EXPECT_EQ(poses.rotations, alone.rotations);
    EXPECT_EQ(poses.directions, alone.directions);
    EXPECT_EQ(poses.tips, alone.tips);
  }
}

}  // namespace
}  // namespace kinefile
