// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cassert>

#include "kinefile/kinematics.hpp"

namespace kinefile {
namespace {

void compute(const Skeleton& skeleton, const Clip& clip, const KinematicsOptions& options,
             bool is_local, PoseArrays& out) {
  assert(clip.num_coordinates == skeleton.coordinates.size());
  out.first_frame = std::min(options.first_frame, clip.num_frames);
  out.frame_step = std::clamp<std::size_t>(options.frame_step, 1, clip.num_frames + 1);
  const std::size_t num_left = clip.num_frames - out.first_frame;
  out.num_frames = std::min(options.num_frames, (num_left + out.frame_step - 1) / out.frame_step);
  out.num_joints = skeleton.joints.size();
  out.num_tips = num_tips(skeleton);
  const std::size_t num_poses = out.num_frames * out.num_joints;
  out.positions.resize(num_poses * 3);
  if (options.rotations) out.rotations.resize(num_poses * 4);
  if (options.directions) out.directions.resize(num_poses * 3);
  if (options.tips) out.tips.resize(out.num_frames * out.num_tips * 3);
  const std::span<const double> values = clip.values;
  const ValueRows rows{values.subspan(out.first_frame * clip.num_coordinates), out.num_frames,
                       clip.num_coordinates * out.frame_step};
  const PoseSpans spans{out.positions.mutate(), out.rotations.mutate(), out.directions.mutate(),
                        out.tips.mutate()};
  const Kinematics kinematics(skeleton);
  is_local ? kinematics.place_locally(rows, spans) : kinematics.place(rows, spans);
}

}  // namespace

WorldPoses forward_kinematics(const Skeleton& skeleton, const Clip& clip,
                              const KinematicsOptions& options) {
  WorldPoses poses;
  compute(skeleton, clip, options, false, poses);
  return poses;
}

LocalPoses local_poses(const Skeleton& skeleton, const Clip& clip,
                       const KinematicsOptions& options) {
  LocalPoses poses;
  compute(skeleton, clip, options, true, poses);
  return poses;
}

}  // namespace kinefile
