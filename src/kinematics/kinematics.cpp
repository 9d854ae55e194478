// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel.hpp"
#include "kinefile/threads.hpp"
#include "kinematics/kinematics_plan.hpp"

namespace kinefile {
namespace {

simd::Vector vector_of(const Vec3& v) { return {v[0], v[1], v[2]}; }

simd::Matrix matrix_of(const Mat3& m) {
  return {vector_of(m.col(0)), vector_of(m.col(1)), vector_of(m.col(2))};
}

/// The kernel's number of an axis: 0, 1 or 2 along x, y or z, up to its sign; 3 for any other.
std::size_t kernel_axis(const Vec3& axis) {
  const auto along = coordinate_axis(axis);
  return along ? *along : coordinate_axis(-axis).value_or(3);
}

simd::Input input_of(const DegreeOfFreedom& dof) { return {dof.coordinate, dof.gain, dof.shift}; }

void plan_whole(simd::WholeRotation kind, std::size_t coordinate, simd::PlannedJoint& planned) {
  planned.whole = kind;
  planned.whole_coordinate = coordinate;
}

void plan_dof(const DegreeOfFreedom& dof, const Mat3& rest_rotation, simd::PlannedJoint& planned) {
  switch (dof.kind) {
    case DofKind::Rotation:
      planned.turns.push_back(plan_turn(dof));
      break;
    case DofKind::Translation:
      planned.shifts.push_back({input_of(dof), vector_of(rest_rotation * dof.axis)});
      break;
    case DofKind::Free:
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 axis = rest_rotation.col(static_cast<Eigen::Index>(k));
        planned.shifts.push_back({{dof.coordinate + k}, vector_of(axis)});
      }
      plan_whole(simd::WholeRotation::Quaternion, dof.coordinate + 3, planned);
      break;
    case DofKind::Ball:
      plan_whole(simd::WholeRotation::Quaternion, dof.coordinate, planned);
      break;
    case DofKind::RotationVector:
      plan_whole(simd::WholeRotation::AxisAngle, dof.coordinate, planned);
      break;
    case DofKind::TailTranslation:
    case DofKind::TailScale:
      planned.tail_moves.push_back({input_of(dof), dof.kind == DofKind::TailScale,
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
  const Quat& q = joint.rest_rotation;
  planned.rest_quaternion = {q.w(), q.x(), q.y(), q.z()};
  planned.direction = vector_of(direction);
  for (const DegreeOfFreedom& dof : joint.dofs) plan_dof(dof, rest_rotation, planned);
  for (const Tip& tip : joint.tips) planned.tips.push_back(vector_of(tip.offset));
  return planned;
}

/// Gives each joint a slot for its pose. A slot is free again when the last child has been placed:
/// so there are as many as the tree is deep, or a few more, and they stay in the fastest memory.
void assign_slots(simd::Plan& plan) {
  std::vector<std::size_t> last_child(plan.joints.size(), simd::kNoJoint);
  for (std::size_t j = 0; j < plan.joints.size(); ++j) {
    if (plan.joints[j].parent != simd::kNoJoint) last_child[plan.joints[j].parent] = j;
  }
  std::vector<std::size_t> free;
  for (std::size_t j = 0; j < plan.joints.size(); ++j) {
    simd::PlannedJoint& joint = plan.joints[j];
    if (free.empty()) free.push_back(plan.num_slots++);
    joint.slot = free.back();
    free.pop_back();
    if (last_child[j] == simd::kNoJoint) free.push_back(joint.slot);
    if (joint.parent != simd::kNoJoint && last_child[joint.parent] == j) {
      free.push_back(plan.joints[joint.parent].slot);
    }
  }
}

/// Whether unit quaternions can stand for a joint's rotations, exactly.
bool has_quaternions(const Joint& joint) {
  constexpr double kTolerance = 1e-14;
  const auto is_unit = [](double square) { return std::abs(square - 1) <= kTolerance; };
  return is_unit(joint.rest_rotation.squaredNorm()) &&
         std::all_of(joint.dofs.begin(), joint.dofs.end(), [&](const DegreeOfFreedom& dof) {
           const bool is_whole = dof.kind == DofKind::Free || dof.kind == DofKind::Ball ||
                                 dof.kind == DofKind::RotationVector;
           return !is_whole && (dof.kind != DofKind::Rotation || is_unit(dof.axis.squaredNorm()));
         });
}

simd::Plan make_plan(const Skeleton& skeleton) {
  simd::Plan plan;
  plan.is_in_degrees = skeleton.angle_unit == AngleUnit::Degrees;
  const std::vector<Vec3> directions = bone_directions(skeleton);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    plan.joints.push_back(plan_joint(skeleton.joints[j], directions[j]));
  }
  plan.has_quaternions =
      std::all_of(skeleton.joints.begin(), skeleton.joints.end(), has_quaternions);
  plan.num_columns = skeleton.coordinates.size();
  assign_slots(plan);
  return plan;
}

/// How many frames a thread places at a time, all of them if they are not worth a thread. Parts are
/// large, since what is large is written past the caches.
std::size_t frames_per_part(std::size_t num_frames, std::size_t num_joints) {
  constexpr std::size_t kFewestPoses = std::size_t{1} << 14;
  constexpr std::size_t kPartsPerThread = 4;
  constexpr std::size_t kFramesTogether = 32;  // the kernel's groups stay whole
  const std::size_t num_threads = max_threads();
  if (!kHasThreads || num_threads < 2) return num_frames;
  const std::size_t fewest = kFewestPoses / std::max<std::size_t>(num_joints, 1);
  const std::size_t frames = std::max(num_frames / (kPartsPerThread * num_threads), fewest);
  return (frames / kFramesTogether + 1) * kFramesTogether;
}

template <class T>
void place_rows(const simd::Plan& plan, simd::Frame frame, const ValueRows& rows,
                std::size_t num_tips, const BasicPoseSpans<T>& out) {
  [[maybe_unused]] const std::size_t num_poses = rows.num_frames * plan.joints.size();
  [[maybe_unused]] const auto fits = [](std::span<T> span, std::size_t size) {
    return span.empty() || span.size() == size;
  };
  assert(out.positions.size() == num_poses * 3 && fits(out.rotations, num_poses * 4));
  assert(fits(out.directions, num_poses * 3) && fits(out.tips, rows.num_frames * num_tips * 3));
  const std::size_t num_joints = plan.joints.size();
  const auto from = [](std::span<T> span, std::size_t first) {
    return span.empty() ? nullptr : span.data() + first;
  };
  const auto place = [&](std::size_t first, std::size_t count) {
    simd::place_frames(plan, frame, {rows.values.data() + first * rows.stride, count, rows.stride},
                       simd::PoseOutput<T>{from(out.positions, first * num_joints * 3),
                                           from(out.rotations, first * num_joints * 4),
                                           from(out.directions, first * num_joints * 3),
                                           from(out.tips, first * num_tips * 3), num_tips});
  };
  const std::size_t part = frames_per_part(rows.num_frames, num_joints);
  if (part >= rows.num_frames) return place(0, rows.num_frames);
  for_each_index((rows.num_frames + part - 1) / part, [&](std::size_t i) {
    place(i * part, std::min(part, rows.num_frames - i * part));
  });
}

}  // namespace

simd::Turn plan_turn(const DegreeOfFreedom& dof) {
  return {input_of(dof), kernel_axis(dof.axis), dof.axis.sum() < 0 ? -1.0 : 1.0,
          vector_of(dof.axis)};
}

Kinematics::Kinematics(const Skeleton& skeleton) {
  auto plan = std::make_shared<Plan>();
  plan->joints = make_plan(skeleton);
  plan->num_coordinates = skeleton.coordinates.size();
  plan->num_tips = kinefile::num_tips(skeleton);
  plan->radians_per_unit = radians_per(skeleton.angle_unit);
  plan_ = std::move(plan);
}

std::size_t Kinematics::num_joints() const { return plan_->joints.joints.size(); }
std::size_t Kinematics::num_tips() const { return plan_->num_tips; }
std::size_t Kinematics::num_coordinates() const { return plan_->num_coordinates; }

void Kinematics::place(const ValueRows& rows, const PoseSpans& out) const {
  place_rows(plan_->joints, simd::Frame::World, rows, plan_->num_tips, out);
}

void Kinematics::place(const ValueRows& rows, const FloatPoseSpans& out) const {
  place_rows(plan_->joints, simd::Frame::World, rows, plan_->num_tips, out);
}

void Kinematics::place_locally(const ValueRows& rows, const PoseSpans& out) const {
  place_rows(plan_->joints, simd::Frame::Parent, rows, plan_->num_tips, out);
}

void Kinematics::place_locally(const ValueRows& rows, const FloatPoseSpans& out) const {
  place_rows(plan_->joints, simd::Frame::Parent, rows, plan_->num_tips, out);
}

}  // namespace kinefile
