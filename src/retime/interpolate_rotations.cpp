// SPDX-License-Identifier: MIT
// Works on some dozen new frames at a time, joint by joint: first computes the rotations of all
// old frames that these need, then all new ones between them, in arrays that stay in the cache.

#include "retime/interpolate_rotations.hpp"

#include <algorithm>
#include <span>

#include "kinefile/joint_rotation.hpp"
#include "kinematics/joint_columns.hpp"
#include "rotation/rotations.hpp"

namespace kinefile::retime {
namespace {

using rotation::put_quaternion;
using rotation::quaternion_at;
using rotation::resize;

constexpr std::size_t kStepsPerBatch = 64;  ///< of which all rows stay in the fastest memory

/// Some new frames and the old ones that they need. Old frames are indices of `old_frames`.
struct Batch {
  std::vector<Step> steps;                   ///< none of them a copy
  std::vector<std::size_t> old_frames;       ///< rising
  std::vector<simd::Neighbours> neighbours;  ///< one per old frame, padded
  std::vector<simd::Between> places;         ///< one per step, padded
  std::vector<std::vector<Tap>> taps;        ///< one per step, empty if it is not an average
};

std::size_t index_of(const std::vector<std::size_t>& old_frames, std::size_t frame) {
  const auto found = std::lower_bound(old_frames.begin(), old_frames.end(), frame);
  return static_cast<std::size_t>(found - old_frames.begin());
}

/// The old frames that are needed, once each. Most maps increase, so they are nearly sorted.
void collect_old_frames(std::size_t num_old_frames, bool is_cubic, Batch& batch) {
  std::vector<std::size_t>& frames = batch.old_frames;
  for (std::size_t i = 0; i < batch.steps.size(); ++i) {
    const Around needed = around(batch.steps[i], num_old_frames);
    frames.insert(frames.end(), {needed.from, needed.to});
    if (is_cubic) frames.insert(frames.end(), {needed.before, needed.after});
    for (const Tap& tap : batch.taps[i]) frames.push_back(tap.old_frame);
  }
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
}

/// The neighbours of each old frame. Frames at the ends of the motion lack a neighbour. Frames that
/// are here only as neighbours of others may lack one, too; it is not needed.
void find_neighbours(Batch& batch) {
  const std::vector<std::size_t>& frames = batch.old_frames;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const bool has_before = i > 0 && frames[i - 1] + 1 == frames[i];
    const bool has_after = i + 1 < frames.size() && frames[i] + 1 == frames[i + 1];
    batch.neighbours.push_back({has_before ? i - 1 : i, has_after ? i + 1 : i});
  }
  batch.neighbours.resize(simd::padded(frames.size()), {0, 0});
}

Batch make_batch(std::vector<Step> steps, std::size_t num_old_frames, bool is_cubic) {
  Batch batch;
  batch.steps = std::move(steps);
  for (const Step& step : batch.steps) {
    batch.taps.push_back(step.is_average() ? taps_of(step, num_old_frames) : std::vector<Tap>());
  }
  collect_old_frames(num_old_frames, is_cubic, batch);
  if (is_cubic) find_neighbours(batch);
  const auto index = [&batch](std::size_t frame) { return index_of(batch.old_frames, frame); };
  for (std::size_t i = 0; i < batch.steps.size(); ++i) {
    const Around frames = around(batch.steps[i], num_old_frames);
    batch.places.push_back({index(frames.from), index(frames.to), batch.steps[i].t});
    for (Tap& tap : batch.taps[i]) tap.old_frame = index(tap.old_frame);
  }
  batch.places.resize(simd::padded(batch.places.size()), {0, 0, 0});
  return batch;
}

/// The mean of rotations that are close together: the mean of their quaternions on one side.
Quat average(const simd::Quaternions& old, const std::vector<Tap>& taps, std::size_t from) {
  const Quat side = quaternion_at(old, from);
  Quat::Coefficients sum = Quat::Coefficients::Zero();
  for (const Tap& tap : taps) {
    sum += tap.weight * on_side_of(quaternion_at(old, tap.old_frame), side).coeffs();
  }
  return Quat(sum);
}

/// Buffers for a joint, reused for the next one.
struct Workspace {
  simd::Angles old_angles;
  simd::Angles new_angles;
  simd::Quaternions old_rotations;
  simd::Quaternions controls;
  simd::Quaternions new_rotations;
};

/// Finds the rotations of a batch's new frames. Their quaternions' lengths are not always 1.
void interpolate(const Batch& batch, RotationInterpolation rotation, Workspace& work) {
  const simd::Quaternions& old = work.old_rotations;
  if (rotation == RotationInterpolation::Cubic) {
    simd::squad_controls(old, batch.neighbours, work.controls);
    simd::squad(old, work.controls, batch.places, work.new_rotations);
  } else if (rotation == RotationInterpolation::Nlerp) {
    simd::nlerp(old, batch.places, work.new_rotations);
  } else {
    simd::slerp(old, batch.places, work.new_rotations);
  }
  for (std::size_t i = 0; i < batch.steps.size(); ++i) {
    if (!batch.steps[i].is_average()) continue;
    put_quaternion(average(old, batch.taps[i], batch.places[i].from), i, work.new_rotations);
  }
}

bool has_plain_values(const TurningJoint& joint) {
  return std::all_of(joint.rotations.begin(), joint.rotations.end(),
                     [](const DegreeOfFreedom& dof) { return is_plain(dof); });
}

std::array<std::size_t, 3> columns_of(const std::array<DegreeOfFreedom, 3>& dofs) {
  return {dofs[0].coordinate, dofs[1].coordinate, dofs[2].coordinate};
}

/// The angles of a joint in some rows.
/// \param frame_of  the frame of each
template <class FrameOf>
void load_angles(const Clip& clip, const TurningJoint& joint, std::size_t count,
                 const FrameOf& frame_of, simd::Angles& angles) {
  resize(angles, count);
  const double* rows = clip.row(0).data();
  const std::array<DegreeOfFreedom, 3>& dofs = joint.rotations;
  double* a = angles[0].data();
  double* b = angles[1].data();
  double* c = angles[2].data();
  const auto [first, second, third] = columns_of(dofs);
  for (std::size_t i = 0; i < count; ++i) {
    const double* row = rows + frame_of(i) * clip.num_coordinates;
    a[i] = row[first];
    b[i] = row[second];
    c[i] = row[third];
  }
  if (has_plain_values(joint)) return;
  for (std::size_t k = 0; k < 3; ++k) {
    for (double& angle : angles[k]) angle = value_of(dofs[k], angle);
  }
}

/// Writes the angles of a joint to the new rows.
void store_angles(const Batch& batch, const TurningJoint& joint, simd::Angles& angles,
                  Clip& new_clip) {
  const std::array<DegreeOfFreedom, 3>& dofs = joint.rotations;
  if (!has_plain_values(joint)) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (double& angle : angles[k]) angle = column_of(dofs[k], angle);
    }
  }
  const double* a = angles[0].data();
  const double* b = angles[1].data();
  const double* c = angles[2].data();
  const auto [first, second, third] = columns_of(dofs);
  double* rows = new_clip.mutate()[0].data();
  for (std::size_t i = 0; i < batch.steps.size(); ++i) {
    double* row = rows + batch.steps[i].new_frame * new_clip.num_coordinates;
    row[first] = a[i];
    row[second] = b[i];
    row[third] = c[i];
  }
}

void turn_joint(const Clip& old_clip, const Batch& batch, const TurningJoint& joint,
                RotationInterpolation rotation, Workspace& work, Clip& new_clip) {
  const std::vector<std::size_t>& old_frames = batch.old_frames;
  load_angles(
      old_clip, joint, old_frames.size(), [&](std::size_t i) { return old_frames[i]; },
      work.old_angles);
  simd::quaternions_of_angles(joint.form, work.old_angles, work.old_rotations);
  interpolate(batch, rotation, work);
  load_angles(
      new_clip, joint, batch.steps.size(), [&](std::size_t i) { return batch.steps[i].new_frame; },
      work.new_angles);
  simd::angles_of_quaternions(joint.form, work.new_rotations, work.new_angles);
  store_angles(batch, joint, work.new_angles, new_clip);
}

void turn_as_whole(const Clip& old_clip, const Batch& batch, const WholeRotation& whole,
                   RotationInterpolation rotation, Workspace& work, Clip& new_clip) {
  resize(work.old_rotations, batch.old_frames.size());
  for (std::size_t i = 0; i < batch.old_frames.size(); ++i) {
    const auto row = old_clip.row(batch.old_frames[i]);
    put_quaternion(whole_rotation_in_row(whole.dof, row, whole.unit), i, work.old_rotations);
  }
  interpolate(batch, rotation, work);
  const Rows rows = new_clip.mutate();
  for (std::size_t i = 0; i < batch.steps.size(); ++i) {
    const std::span<double> row = rows[batch.steps[i].new_frame];
    const Quat result = quaternion_at(work.new_rotations, i).normalized();
    if (whole.dof.kind == DofKind::RotationVector) {
      // Near the vector between the old ones, which is in the row.
      set_whole_rotation(whole.dof, result, whole.unit, row);
      continue;
    }
    const Quat sided = on_side_of(result, quaternion_at(work.old_rotations, batch.places[i].from));
    double* q = &row[whole.dof.coordinate];
    q[0] = sided.w();
    q[1] = sided.x();
    q[2] = sided.y();
    q[3] = sided.z();
  }
}

}  // namespace

void interpolate_rotations(const Clip& old_clip, const std::vector<Step>& steps,
                           const InterpolationPlan& plan, RotationInterpolation rotation,
                           Clip& new_clip) {
  if (plan.turning_joints.empty() && plan.whole_rotations.empty()) return;
  Workspace work;
  auto next = steps.begin();
  while (next != steps.end()) {
    std::vector<Step> some;
    for (; next != steps.end() && some.size() < kStepsPerBatch; ++next) {
      if (!next->is_copy()) some.push_back(*next);
    }
    const bool is_cubic = rotation == RotationInterpolation::Cubic;
    const Batch batch = make_batch(std::move(some), old_clip.num_frames, is_cubic);
    if (batch.steps.empty()) continue;
    for (const TurningJoint& joint : plan.turning_joints) {
      turn_joint(old_clip, batch, joint, rotation, work, new_clip);
    }
    for (const WholeRotation& whole : plan.whole_rotations) {
      turn_as_whole(old_clip, batch, whole, rotation, work, new_clip);
    }
  }
}

}  // namespace kinefile::retime
