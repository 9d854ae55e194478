// SPDX-License-Identifier: MIT
#include "support/motion_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "kinefile/kinematics.hpp"

namespace kinefile::test {

double world_size(const Motion& motion) {
  double size = 1;
  const bool has_frames = motion.clip.num_frames > 0;
  const Clip clip = has_frames ? motion.clip : rest_clip(motion.skeleton);
  const WorldPoses poses = forward_kinematics(motion.skeleton, clip, {.tips = true});
  for (const double p : poses.positions) size = std::max(size, std::abs(p));
  for (const double p : poses.tips) size = std::max(size, std::abs(p));
  return size;
}

std::size_t num_shapes(const Skeleton& skeleton) {
  std::size_t count = 0;
  for (const Joint& joint : skeleton.joints) count += joint.visuals.size();
  return count;
}

std::vector<Vec3> places_of_shapes(const Motion& motion, bool rest) {
  const WorldPoses poses = forward_kinematics(
      motion.skeleton, rest ? rest_clip(motion.skeleton) : motion.clip, {.rotations = true});
  std::vector<Vec3> places;
  for (std::size_t f = 0; f < poses.num_frames; ++f) {
    for (std::size_t j = 0; j < poses.num_joints; ++j) {
      const std::size_t i = f * poses.num_joints + j;
      const double* q = &poses.rotations[i * 4];
      const Quat turn(q[0], q[1], q[2], q[3]);
      for (const VisualShape& shape : motion.skeleton.joints[j].visuals) {
        const Vec3 middle = Vec3(&poses.positions[i * 3]) + turn * shape.position;
        places.push_back(middle);
        for (Eigen::Index k = 0; k < 3; ++k) {
          const Vec3 side = shape.size[k] / 2 * Vec3::Unit(k);
          places.emplace_back(middle + turn * (shape.rotation * side));
        }
      }
    }
  }
  return places;
}

namespace {

/// What tells shapes apart: their red, which nothing changes.
std::vector<double> reds_of_shapes(const Skeleton& skeleton) {
  std::vector<double> reds;
  for (const Joint& joint : skeleton.joints) {
    for (const VisualShape& shape : joint.visuals) {
      reds.push_back(shape.colour.value_or(Vec3::Zero()).x());
    }
  }
  return reds;
}

/// Compares the shapes that both have.
void compare_shapes(const Motion& a, const Motion& b, bool is_at_rest, double size,
                    WorldDifference& difference) {
  const auto places_a = places_of_shapes(a, is_at_rest);
  const auto places_b = places_of_shapes(b, is_at_rest);
  const auto reds_a = reds_of_shapes(a.skeleton);
  const auto reds_b = reds_of_shapes(b.skeleton);
  for (std::size_t i = 0; i < reds_a.size(); ++i) {
    const auto found = std::find(reds_b.begin(), reds_b.end(), reds_a[i]);
    if (found == reds_b.end()) continue;
    ++difference.num_shapes;
    const auto k = static_cast<std::size_t>(found - reds_b.begin());
    for (std::size_t f = 0; f < places_a.size() / (reds_a.size() * 4); ++f) {
      for (std::size_t point = 0; point < 4; ++point) {
        const double apart = (places_a.at((f * reds_a.size() + i) * 4 + point) -
                              places_b.at((f * reds_b.size() + k) * 4 + point))
                                 .norm() /
                             size;
        if (!(apart <= difference.shape)) difference.shape = apart;  // NaN, too
      }
    }
  }
}

}  // namespace

WorldDifference world_difference(const Motion& a, const Motion& b, bool rest) {
  const bool is_at_rest = rest || (a.clip.num_frames == 0 && b.clip.num_frames == 0);
  const Clip clip_a = is_at_rest ? rest_clip(a.skeleton) : a.clip;
  const Clip clip_b = is_at_rest ? rest_clip(b.skeleton) : b.clip;
  EXPECT_EQ(clip_a.num_frames, clip_b.num_frames);
  const KinematicsOptions options = {.rotations = true, .tips = true};
  const WorldPoses poses_a = forward_kinematics(a.skeleton, clip_a, options);
  const WorldPoses poses_b = forward_kinematics(b.skeleton, clip_b, options);
  std::map<std::string, std::size_t> index_of;
  for (std::size_t j = 0; j < b.skeleton.joints.size(); ++j) {
    index_of.try_emplace(b.skeleton.joints[j].name, j);
  }
  const auto first_tips_a = first_tips_of_joints(a.skeleton);
  const auto first_tips_b = first_tips_of_joints(b.skeleton);
  const double size = world_size(a);
  const auto at = [](const Array<double>& numbers, std::size_t index) {
    return Vec3(numbers.data() + index * 3);
  };
  const auto turn = [](const PoseArrays& poses, std::size_t index) {
    const double* q = poses.rotations.data() + index * 4;
    return Quat(q[0], q[1], q[2], q[3]);
  };
  const auto keep = [](double& largest, double value) {
    if (!(value <= largest)) largest = value;  // NaN, too
  };
  WorldDifference difference;
  for (std::size_t j = 0; j < a.skeleton.joints.size(); ++j) {
    const auto found = index_of.find(a.skeleton.joints[j].name);
    if (found == index_of.end()) continue;
    ++difference.num_joints;
    const std::size_t num_tips_a = a.skeleton.joints[j].tips.size();
    const bool has_same_tips = num_tips_a == b.skeleton.joints[found->second].tips.size();
    for (std::size_t f = 0; f < std::min(poses_a.num_frames, poses_b.num_frames); ++f) {
      const std::size_t i = f * poses_a.num_joints + j;
      const std::size_t k = f * poses_b.num_joints + found->second;
      keep(difference.position,
           (at(poses_a.positions, i) - at(poses_b.positions, k)).norm() / size);
      keep(difference.rotation, angle_between(turn(poses_a, i), turn(poses_b, k)));
      for (std::size_t t = 0; t < num_tips_a && has_same_tips; ++t) {
        const Vec3 tip_a = at(poses_a.tips, f * poses_a.num_tips + first_tips_a[j] + t);
        const Vec3 tip_b = at(poses_b.tips, f * poses_b.num_tips + first_tips_b[found->second] + t);
        keep(difference.tip, (tip_a - tip_b).norm() / size);
      }
    }
  }
  compare_shapes(a, b, is_at_rest, size, difference);
  return difference;
}

bool same_bits(std::span<const double> a, std::span<const double> b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

bool same_skeleton(const Skeleton& a, const Skeleton& b) {
  const auto same_dof = [](const DegreeOfFreedom& x, const DegreeOfFreedom& y) {
    return x.kind == y.kind && x.axis == y.axis && x.coordinate == y.coordinate &&
           x.rest == y.rest && x.lower == y.lower && x.upper == y.upper &&
           x.max_speed == y.max_speed && x.gain == y.gain && x.shift == y.shift;
  };
  const auto same_tip = [](const Tip& x, const Tip& y) {
    return x.name == y.name && x.offset == y.offset;
  };
  // Rotations of shapes are multiplied where frames turn.
  const auto same_shape = [](const VisualShape& x, const VisualShape& y) {
    return x.kind == y.kind && x.size == y.size && x.position == y.position &&
           (x.rotation.coeffs() - y.rotation.coeffs()).norm() < 1e-15 && x.colour == y.colour;
  };
  const auto same_joint = [&](const Joint& x, const Joint& y) {
    return x.name == y.name && x.joint_name == y.joint_name && x.parent == y.parent &&
           x.offset == y.offset && x.rest_rotation.coeffs() == y.rest_rotation.coeffs() &&
           x.free_rest == y.free_rest &&
           std::equal(x.dofs.begin(), x.dofs.end(), y.dofs.begin(), y.dofs.end(), same_dof) &&
           std::equal(x.tips.begin(), x.tips.end(), y.tips.begin(), y.tips.end(), same_tip) &&
           std::equal(x.visuals.begin(), x.visuals.end(), y.visuals.begin(), y.visuals.end(),
                      same_shape);
  };
  const auto same_column = [](const Coordinate& x, const Coordinate& y) {
    return x.joint == y.joint && x.channel == y.channel;
  };
  return a.name == b.name && a.angle_unit == b.angle_unit &&
         a.metres_per_unit == b.metres_per_unit &&
         std::equal(a.joints.begin(), a.joints.end(), b.joints.begin(), b.joints.end(),
                    same_joint) &&
         std::equal(a.coordinates.begin(), a.coordinates.end(), b.coordinates.begin(),
                    b.coordinates.end(), same_column);
}

ExpectUnchanged::ExpectUnchanged(const Motion& motion)
    : motion_(motion),
      skeleton_(motion.skeleton),
      values_(motion.clip.values.begin(), motion.clip.values.end()),
      timeline_(motion.clip.timeline) {}

ExpectUnchanged::~ExpectUnchanged() {
  EXPECT_TRUE(same_skeleton(skeleton_, motion_.skeleton)) << "the input's skeleton changed";
  EXPECT_TRUE(same_bits(values_, motion_.clip.values)) << "the input's values changed";
  EXPECT_EQ(timeline_, motion_.clip.timeline);
}

std::size_t count_code(const Diagnostics& diagnostics, std::string_view code) {
  return static_cast<std::size_t>(
      std::count_if(diagnostics.items().begin(), diagnostics.items().end(),
                    [code](const Diagnostic& item) { return item.code == code; }));
}

}  // namespace kinefile::test
