// SPDX-License-Identifier: MIT
#include "simd/forward_kinematics.hpp"

#include <algorithm>
#include <cassert>

#include "kinefile/kinematics.hpp"

namespace kinefile {
namespace {

simd::Vector vector_of(const Vec3& v) { return {v[0], v[1], v[2]}; }

simd::Matrix matrix_of(const Mat3& m) {
  return {vector_of(m.col(0)), vector_of(m.col(1)), vector_of(m.col(2))};
}

/// The kernel's word for an axis: 0, 1 or 2 along x, y or z, up to its sign; 3 for any other.
std::size_t kernel_axis(const Vec3& axis) {
  const auto along = coordinate_axis(axis);
  return along ? *along : coordinate_axis(-axis).value_or(3);
}

simd::Turn plan_turn(const DegreeOfFreedom& dof) {
  return {dof.coordinate, kernel_axis(dof.axis), dof.axis.sum() < 0 ? -1.0 : 1.0,
          vector_of(dof.axis)};
}

void plan_dof(const DegreeOfFreedom& dof, const Mat3& rest_rotation, simd::PlannedJoint& planned) {
  switch (dof.kind) {
    case DofKind::Rotation:
      planned.turns.push_back(plan_turn(dof));
      break;
    case DofKind::Translation:
      planned.shifts.push_back({dof.coordinate, vector_of(rest_rotation * dof.axis)});
      break;
    case DofKind::Free:
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 axis = rest_rotation.col(static_cast<Eigen::Index>(k));
        planned.shifts.push_back({dof.coordinate + k, vector_of(axis)});
      }
      planned.is_free = true;
      planned.quaternion_coordinate = dof.coordinate + 3;
      break;
    case DofKind::TailTranslation:
    case DofKind::TailScale:
      planned.tail_moves.push_back({dof.coordinate, dof.kind == DofKind::TailScale,
                                    kernel_axis(dof.axis), vector_of(dof.axis)});
      break;
  }
}

simd::PlannedJoint plan_joint(const Joint& joint, const Vec3& direction) {
  const Mat3 rest_rotation = joint.rest_rotation.toRotationMatrix();
  simd::PlannedJoint planned;
  planned.parent = joint.parent == kNoParent ? simd::kNoJoint : joint.parent;
  planned.offset = vector_of(joint.offset);
  planned.has_rest_rotation = rest_rotation != Mat3::Identity();
  planned.rest_rotation = matrix_of(rest_rotation);
  planned.direction = vector_of(direction);
  for (const DegreeOfFreedom& dof : joint.dofs) plan_dof(dof, rest_rotation, planned);
  for (const Tip& tip : joint.tips) planned.tips.push_back(vector_of(tip.offset));
  return planned;
}

simd::Plan make_plan(const Skeleton& skeleton, bool is_local) {
  simd::Plan plan;
  plan.is_in_degrees = skeleton.angle_unit == AngleUnit::Degrees;
  plan.is_local = is_local;
  const std::vector<Vec3> directions = bone_directions(skeleton);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    plan.joints.push_back(plan_joint(skeleton.joints[j], directions[j]));
  }
  return plan;
}

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
  const auto data = [](Array<double>& array) { return array.mutate().data(); };
  const simd::Rows rows{clip.values.data() + out.first_frame * clip.num_coordinates, out.num_frames,
                        clip.num_coordinates * out.frame_step};
  simd::place_frames(make_plan(skeleton, is_local), rows,
                     {data(out.positions), data(out.rotations), data(out.directions),
                      data(out.tips), out.num_tips});
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
