// SPDX-License-Identifier: MIT
#include "kinefile/body_motion.hpp"

#include <algorithm>
#include <cmath>

#include "kinefile/math.hpp"

namespace kinefile {

const Component* find_component(const BodyMotion& motion, ComponentKind kind,
                                std::string_view content) {
  const auto found = std::find_if(motion.components.rbegin(), motion.components.rend(),
                                  [&](const Component& component) {
                                    return component.kind == kind && component.content == content;
                                  });
  return found == motion.components.rend() ? nullptr : &*found;
}

const Component* main_component(const BodyMotion& motion) {
  if (const auto* links = find_component(motion, ComponentKind::Poses, kLinkPosition)) return links;
  const auto* joints = find_component(motion, ComponentKind::Values, kJointDisplacement);
  if (joints != nullptr) return joints;
  const auto known = std::find_if(
      motion.components.begin(), motion.components.end(),
      [](const Component& component) { return component.kind != ComponentKind::Other; });
  return known == motion.components.end() ? nullptr : &*known;
}

std::array<double, 4> quaternion_of_pose(PoseForm form, std::span<const double> pose) {
  if (form == PoseForm::Quaternion) return {pose[3], pose[4], pose[5], pose[6]};
  // The entries are computed as in Choreonoid, so that the results are the same bit for bit.
  const double sr = std::sin(pose[3]), cr = std::cos(pose[3]);
  const double sp = std::sin(pose[4]), cp = std::cos(pose[4]);
  const double sy = std::sin(pose[5]), cy = std::cos(pose[5]);
  Mat3 rotation;
  rotation << cp * cy, sr * sp * cy - cr * sy, cr * sp * cy + sr * sy,  //
      cp * sy, sr * sp * sy + cr * cy, cr * sp * sy - sr * cy,          //
      -sp, sr * cp, cr * cp;
  const Quat q(rotation);
  return {q.w(), q.x(), q.y(), q.z()};
}

Array<double> poses_as_roll_pitch_yaw(const Component& component) {
  Array<double> values(component.num_frames * component.num_parts * 6);
  const std::span<double> written = values.mutate();
  const EulerAxes axes = {Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitX()};
  for (std::size_t p = 0; p < component.num_parts; ++p) {
    Vec3 near = Vec3::Zero();
    for (std::size_t f = 0; f < component.num_frames; ++f) {
      const auto pose = component.row(f).subspan(p * 7, 7);
      const Quat q = unit_quaternion({pose[3], pose[4], pose[5], pose[6]});
      near = euler_angles(q.toRotationMatrix(), axes, near);
      double* out = written.data() + (f * component.num_parts + p) * 6;
      std::copy(pose.begin(), pose.begin() + 3, out);
      for (Eigen::Index k = 0; k < 3; ++k) out[5 - k] = near[k];
    }
  }
  return values;
}

}  // namespace kinefile
