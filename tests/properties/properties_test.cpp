// SPDX-License-Identifier: MIT
// What holds for every motion, tried on made-up ones with fixed seeds.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "kinefile/bvh.hpp"
#include "kinefile/compare.hpp"
#include "kinefile/kinematics.hpp"
#include "kinefile/shape.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t bound) { return random() % bound; }

/// Numbers of every size, zeros of both signs among them.
double number(Random& random) {
  switch (below(random, 4)) {
    case 0:
      return below(random, 2) == 0 ? 0.0 : -0.0;
    case 1:
      return static_cast<double>(below(random, 2001)) / 10 - 100;
    case 2:
      return std::ldexp(static_cast<double>(random()), static_cast<int>(below(random, 60)) - 90);
    default:
      return std::uniform_real_distribution<double>(-400, 400)(random);
  }
}

/// A BVH text of a random tree with random channels.
std::string random_bvh(Random& random) {
  static const std::vector<std::string> kWords = {"Xposition", "Yposition", "Zposition",
                                                  "Xrotation", "Yrotation", "Zrotation",
                                                  "Xscale",    "Yscale",    "Zscale"};
  std::string text = "HIERARCHY\n";
  std::size_t num_columns = 0;
  std::size_t depth = 0;
  const std::size_t num_joints = 1 + below(random, 12);
  const auto close_one = [&text, &depth] {
    text += "}\n";
    --depth;
  };
  for (std::size_t j = 0; j < num_joints; ++j) {
    while (depth > 0 && below(random, 3) == 0) close_one();
    text += fmt::format("{} j{}\n{{\nOFFSET {} {} {}\n", depth == 0 ? "ROOT" : "JOINT", j,
                        number(random), number(random), number(random));
    const std::size_t num_channels = below(random, 7);
    text += fmt::format("CHANNELS {}", num_channels);
    for (std::size_t c = 0; c < num_channels; ++c) text += " " + kWords[below(random, 9)];
    text += "\n";
    for (std::size_t t = below(random, 3); t > 0; --t) {
      text += fmt::format("End Site{}\n{{\nOFFSET {} {} {}\n}}\n",
                          below(random, 2) == 0 ? "" : fmt::format(" tip {}", t), number(random),
                          number(random), number(random));
    }
    num_columns += num_channels;
    ++depth;
  }
  while (depth > 0) close_one();
  const std::size_t num_frames = 1 + below(random, 40);
  text += fmt::format("MOTION\nFrames: {}\nFrame Time: {}\n", num_frames, 1.0 / 120);
  for (std::size_t f = 0; f < num_frames; ++f) {
    for (std::size_t c = 0; c < num_columns; ++c) text += fmt::format("{} ", number(random));
    text += "\n";
  }
  return text;
}

/// A random motion; positions may be added or replace, and notes on that do not matter here.
ReadText read_random_motion(Random& random) {
  ReadOptions options;
  options.of_formats =
      bvh::ReadOptions{below(random, 2) == 0 ? bvh::PositionMode::Replace : bvh::PositionMode::Add};
  return read_bvh(random_bvh(random), options);
}

bool bits_agree(std::span<const double> a, std::span<const double> b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

TEST(Properties, WhatIsWrittenReadsTheSame) {
  Random random(11);
  for (int i = 0; i < 300; ++i) {
    const ReadText first = read_random_motion(random);
    for (const Diagnostic& item : first.diagnostics.items()) {
      // Channels are random, so that some stand twice.
      const bool is_expected = item.severity == Severity::Note || item.code == "BVH039";
      ASSERT_TRUE(is_expected) << text_of(first.diagnostics);
    }
    const std::string text = write_to_string(*first.document);
    ReadOptions options;
    const bool is_added = fact_of(*first.document, "positions") == "add";
    options.of_formats =
        bvh::ReadOptions{is_added ? bvh::PositionMode::Add : bvh::PositionMode::Replace};
    const ReadText second = read_bvh(text, options);
    EXPECT_TRUE(bits_agree(first.motion().clip.values, second.motion().clip.values));
    EXPECT_EQ(write_to_string(*second.document), text);
    EXPECT_EQ(first.motion().clip.num_frames, second.motion().clip.num_frames);
  }
}

/// world_from_joint by 4 x 4 matrices, joint by joint up the tree: slow, plain, and another way.
std::vector<Eigen::Matrix4d> plain_kinematics(const Skeleton& skeleton,
                                              std::span<const double> row) {
  std::vector<Eigen::Matrix4d> world;
  std::vector<Eigen::Matrix4d> tails;
  for (const Joint& joint : skeleton.joints) {
    Eigen::Affine3d local = Eigen::Affine3d::Identity();
    Eigen::Affine3d tail = Eigen::Affine3d::Identity();
    local.translate(joint.offset);
    local.rotate(joint.rest_rotation);
    for (const DegreeOfFreedom& dof : joint.dofs) {
      const double value = row[dof.coordinate];
      const Vec3& axis = dof.axis;
      if (dof.kind == DofKind::Translation) local.translate(value * axis);
      if (dof.kind == DofKind::Rotation) {
        local.rotate(Eigen::AngleAxisd(std::remainder(value, 360.0) * kRadiansPerDegree, axis));
      }
      if (dof.kind == DofKind::TailScale) {
        const Vec3 stretch = axis.unaryExpr([value](double a) { return a == 0 ? 1 : value; });
        tail.linear() = tail.linear() * stretch.asDiagonal();
      }
    }
    Eigen::Matrix4d from_parent = local.matrix();
    if (joint.parent != kNoParent) {
      // The parent's tail moves where this joint sits, but does not turn or stretch it.
      const Vec3 origin = (Eigen::Affine3d(tails[joint.parent]) * local.translation());
      from_parent.block<3, 1>(0, 3) = origin;
      from_parent = world[joint.parent] * from_parent;
    }
    world.push_back(from_parent);
    tails.push_back(tail.matrix());
  }
  return world;
}

TEST(Properties, TheKernelAgreesWithPlainMatrices) {
  Random random(12);
  for (int i = 0; i < 200; ++i) {
    const ReadText read = read_random_motion(random);
    const Motion& motion = read.motion();
    const WorldPoses poses = forward_kinematics(motion.skeleton, motion.clip, {.rotations = true});
    for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
      const auto plain = plain_kinematics(motion.skeleton, motion.clip.row(f));
      // What the numbers are rounded against: all that is added up on the way.
      double size = 1;
      for (const double value : motion.clip.row(f)) size = std::max(size, std::abs(value));
      for (const Joint& joint : motion.skeleton.joints) {
        size = std::max(size, rest_offset(joint).cwiseAbs().maxCoeff());
      }
      for (const auto& pose : plain) size = std::max(size, pose.cwiseAbs().maxCoeff());
      for (std::size_t j = 0; j < plain.size(); ++j) {
        const std::size_t index = f * poses.num_joints + j;
        for (Eigen::Index k = 0; k < 3; ++k) {
          ASSERT_NEAR(poses.positions[index * 3 + static_cast<std::size_t>(k)], plain[j](k, 3),
                      1e-12 * size);
        }
        const double* q = &poses.rotations[index * 4];
        const Mat3 rotation = Quat(q[0], q[1], q[2], q[3]).toRotationMatrix();
        ASSERT_LT((rotation - plain[j].block<3, 3>(0, 0)).norm(), 1e-11);
      }
    }
  }
}

TEST(Properties, LocalPosesMultiplyToWorldPoses) {
  Random random(13);
  for (int i = 0; i < 100; ++i) {
    const ReadText read = read_random_motion(random);
    const Motion& motion = read.motion();
    const KinematicsOptions options = {.rotations = true};
    const WorldPoses world = forward_kinematics(motion.skeleton, motion.clip, options);
    const LocalPoses local = local_poses(motion.skeleton, motion.clip, options);
    const auto pose = [](const PoseArrays& poses, std::size_t index) {
      const double* p = &poses.positions[index * 3];
      const double* q = &poses.rotations[index * 4];
      return Eigen::Translation3d(p[0], p[1], p[2]) * Quat(q[0], q[1], q[2], q[3]);
    };
    for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
      for (std::size_t j = 0; j < world.num_joints; ++j) {
        const std::size_t parent = motion.skeleton.joints[j].parent;
        const auto here = pose(world, f * world.num_joints + j);
        auto product = pose(local, f * world.num_joints + j);
        if (parent != kNoParent) product = pose(world, f * world.num_joints + parent) * product;
        const double size = 1 + here.matrix().cwiseAbs().maxCoeff();
        EXPECT_LT((product.matrix() - here.matrix()).norm(), 1e-10 * size);
      }
    }
  }
}

TEST(Properties, TurningTheRootTurnsTheWorld) {
  Random random(14);
  for (int i = 0; i < 100; ++i) {
    const ReadText read = read_random_motion(random);
    Motion motion = read.motion();
    const WorldPoses before = forward_kinematics(motion.skeleton, motion.clip);
    const Quat turn = Quat(number(random), 1, number(random), 2).normalized();
    for (Joint& joint : motion.skeleton.joints) {
      if (joint.parent != kNoParent) continue;
      joint.offset = turn * joint.offset;
      joint.rest_rotation = turn * joint.rest_rotation;
    }
    const WorldPoses after = forward_kinematics(motion.skeleton, motion.clip);
    for (std::size_t p = 0; p < before.positions.size(); p += 3) {
      const Vec3 old(before.positions[p], before.positions[p + 1], before.positions[p + 2]);
      const Vec3 now(after.positions[p], after.positions[p + 1], after.positions[p + 2]);
      EXPECT_LT((turn * old - now).norm(), 1e-11 * (1 + old.norm()));
    }
  }
}

TEST(Properties, OtherChannelsMoveTheSame) {
  Random random(15);
  constexpr shape::PositionChannels kPositions[] = {shape::PositionChannels::AsIs,
                                                    shape::PositionChannels::All};
  for (int i = 0; i < 200; ++i) {
    const ReadText read = read_random_motion(random);
    const Motion before = read.motion();
    shape::ChannelOptions options;
    options.positions = kPositions[below(random, 2)];
    const std::size_t a = below(random, 3);
    const std::size_t b = (a + 1 + below(random, 2)) % 3;
    options.order = shape::RotationOrder{a, b, (b + 1 + below(random, 2)) % 3};
    Diagnostics diagnostics;
    const auto after = shape::with_channels(before, options, diagnostics);
    ASSERT_TRUE(after);
    ASSERT_TRUE(validate(after->skeleton));
    const Box box = world_extent(before.skeleton, before.clip);
    const double size = 1 + box.min.cwiseAbs().maxCoeff() + box.max.cwiseAbs().maxCoeff();
    const MotionComparison comparison = compare_motions(before, *after);
    EXPECT_LT(comparison.distance.value, 1e-10 * size);
    EXPECT_LT(comparison.tip_distance.value, 1e-10 * size);
    EXPECT_LT(comparison.rotation.value, 1e-8);
    EXPECT_TRUE(bits_agree(before.clip.values, read.motion().clip.values)) << "input unmodified";
  }
}

}  // namespace
}  // namespace kinefile::test
