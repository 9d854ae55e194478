// SPDX-License-Identifier: MIT
#include "kinefile/joint_curves.hpp"

#include <algorithm>

#include "kinefile/kinematics.hpp"
#include "kinematics/rates.hpp"

namespace kinefile {
namespace {

/// Where a joint is in every frame.
struct JointTrack {
  std::vector<Vec3> positions;
  std::vector<Quat> rotations;
};

std::vector<JointTrack> track_joints(const Motion& motion, std::span<const std::size_t> joints) {
  std::vector<JointTrack> tracks(joints.size());
  for (JointTrack& track : tracks) {
    track.positions.reserve(motion.clip.num_frames);
    track.rotations.reserve(motion.clip.num_frames);
  }
  KinematicsOptions options;
  options.rotations = true;
  options.num_frames = frames_per_block(motion.skeleton);
  for (; options.first_frame < motion.clip.num_frames; options.first_frame += options.num_frames) {
    const WorldPoses poses = forward_kinematics(motion.skeleton, motion.clip, options);
    for (std::size_t row = 0; row < poses.num_frames; ++row) {
      for (std::size_t k = 0; k < joints.size(); ++k) {
        const std::size_t pose = row * poses.num_joints + joints[k];
        const double* q = &poses.rotations[pose * 4];
        tracks[k].positions.emplace_back(&poses.positions[pose * 3]);
        tracks[k].rotations.emplace_back(q[0], q[1], q[2], q[3]);
      }
    }
  }
  return tracks;
}

/// The rotation vector in the world that leads from one rotation to another, in degrees, of up to
/// half a turn.
Vec3 turn_of(const Quat& from, const Quat& to) {
  return 2 * log_of(to * from.conjugate()) / kRadiansPerDegree;
}

JointCurves curves_of(std::size_t joint, const JointTrack& track, const Timeline& timeline) {
  const std::size_t num_frames = track.positions.size();
  JointCurves curves;
  curves.joint = joint;
  curves.positions.resize(num_frames * 3);
  curves.speeds.assign(num_frames, 0);
  curves.angular_speeds.assign(num_frames, 0);
  const std::span<double> positions = curves.positions.mutate();
  const std::span<double> speeds = curves.speeds.mutate();
  const std::span<double> angular_speeds = curves.angular_speeds.mutate();
  for (std::size_t f = 0; f < num_frames; ++f) {
    std::copy_n(track.positions[f].data(), 3, &positions[f * 3]);
    if (num_frames == 1) continue;
    const auto [before, after, seconds] = neighbours_of(timeline, f, num_frames);
    const Vec3 way = track.positions[after] - track.positions[before];
    const Vec3 turn = turn_of(track.rotations[before], track.rotations[f]) +
                      turn_of(track.rotations[f], track.rotations[after]);
    speeds[f] = per_second(way.norm(), seconds);
    angular_speeds[f] = per_second(turn.norm(), seconds);
  }
  return curves;
}

}  // namespace

std::vector<JointCurves> joint_curves(const Motion& motion, std::span<const std::size_t> joints) {
  const std::vector<JointTrack> tracks = track_joints(motion, joints);
  std::vector<JointCurves> curves;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    curves.push_back(curves_of(joints[k], tracks[k], motion.clip.timeline));
  }
  return curves;
}

}  // namespace kinefile
