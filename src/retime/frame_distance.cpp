// SPDX-License-Identifier: MIT
#include "retime/frame_distance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kinefile/kinematics.hpp"

namespace kinefile::retime {
namespace {

/// Copies the numbers of some joints from rows with all joints.
/// \param size  numbers per joint
void append_joints(std::span<const double> all, const PoseArrays& poses, std::size_t size,
                   const std::vector<std::size_t>& joints, std::vector<double>& some) {
  for (std::size_t row = 0; row < poses.num_frames; ++row) {
    for (const std::size_t joint : joints) {
      const double* numbers = &all[(row * poses.num_joints + joint) * size];
      some.insert(some.end(), numbers, numbers + size);
    }
  }
}

/// Rotates the axis that points up, which is not y, to y.
void stand_up(std::size_t up, std::vector<double>& points) {
  for (std::size_t p = 0; p < points.size(); p += 3) {
    points[p + up] = -std::exchange(points[p + 1], points[p + up]);
  }
}

/// Subtracts the mean on the ground from the points of one frame.
/// \returns the sum of their squared distances from it
double centre_on_ground(double* points, std::size_t num_points) {
  double x = 0;
  double z = 0;
  for (std::size_t p = 0; p < num_points; ++p) {
    x += points[p * 3];
    z += points[p * 3 + 2];
  }
  x /= static_cast<double>(num_points);
  z /= static_cast<double>(num_points);
  double spread = 0;
  for (std::size_t p = 0; p < num_points; ++p) {
    points[p * 3] -= x;
    points[p * 3 + 2] -= z;
    spread += points[p * 3] * points[p * 3] + points[p * 3 + 2] * points[p * 3 + 2];
  }
  return spread;
}

}  // namespace

FrameAngles angles_of_frames(const Motion& motion, const std::vector<std::size_t>& joints) {
  FrameAngles frames{joints.size(), {}};
  KinematicsOptions options;
  options.rotations = true;
  options.num_frames = frames_per_block(motion.skeleton);
  for (; options.first_frame < motion.clip.num_frames; options.first_frame += options.num_frames) {
    const LocalPoses poses = local_poses(motion.skeleton, motion.clip, options);
    append_joints(poses.rotations, poses, 4, joints, frames.rotations);
  }
  return frames;
}

FramePoints points_of_frames(const Motion& motion, const std::vector<std::size_t>& joints,
                             double scale, std::size_t up) {
  FramePoints frames{joints.size(), {}, {}};
  KinematicsOptions options;
  options.num_frames = frames_per_block(motion.skeleton);
  for (; options.first_frame < motion.clip.num_frames; options.first_frame += options.num_frames) {
    const WorldPoses poses = forward_kinematics(motion.skeleton, motion.clip, options);
    append_joints(poses.positions, poses, 3, joints, frames.points);
  }
  for (double& number : frames.points) number *= scale;
  if (up != 1) stand_up(up, frames.points);
  for (std::size_t frame = 0; frame < motion.clip.num_frames; ++frame) {
    double* points = frames.points.data() + frame * joints.size() * 3;
    frames.spreads.push_back(centre_on_ground(points, joints.size()));
  }
  return frames;
}

double distance(const FrameAngles& a, std::size_t frame_a, const FrameAngles& b,
                std::size_t frame_b) {
  const double* p = a.rotations.data() + frame_a * a.num_joints * 4;
  const double* q = b.rotations.data() + frame_b * b.num_joints * 4;
  double sum = 0;
  for (const double* end = p + a.num_joints * 4; p != end; p += 4, q += 4) {
    const double dot = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
    const double side = dot < 0 ? -1 : 1;
    double square = 0;
    for (int k = 0; k < 4; ++k) square += (p[k] - side * q[k]) * (p[k] - side * q[k]);
    // Computed from the chord: the arc cosine of the product would not be 0 for equal rotations.
    const double angle = 4 * std::asin(std::min(std::sqrt(square) / 2, 1.0));
    sum += angle * angle;
  }
  return sum;
}

double distance(const FramePoints& a, std::size_t frame_a, const FramePoints& b,
                std::size_t frame_b) {
  const double* p = a.points.data() + frame_a * a.num_joints * 3;
  const double* q = b.points.data() + frame_b * b.num_joints * 3;
  double along = 0;
  double across = 0;
  double heights = 0;
  for (const double* end = p + a.num_joints * 3; p != end; p += 3, q += 3) {
    along += p[0] * q[0] + p[2] * q[2];
    across += p[0] * q[2] - q[0] * p[2];
    heights += (p[1] - q[1]) * (p[1] - q[1]);
  }
  const double ground =
      a.spreads[frame_a] + b.spreads[frame_b] - 2 * std::sqrt(along * along + across * across);
  return std::max(ground, 0.0) + heights;
}

}  // namespace kinefile::retime
