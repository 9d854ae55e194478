// SPDX-License-Identifier: MIT
#include "support/motions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinefile/kinematics.hpp"

namespace kinefile::test {

std::vector<EulerAxes> all_euler_axes() {
  std::vector<EulerAxes> all;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      for (int c = 0; c < 3; ++c) {
        if (a != b && b != c) all.push_back({Vec3::Unit(a), Vec3::Unit(b), Vec3::Unit(c)});
      }
    }
  }
  const Quat tilt(Eigen::AngleAxisd(1.1, Vec3(2, -3, 6) / 7));
  for (std::size_t i = 0; i < 12; ++i) {
    const double sign = i % 2 == 0 ? -1 : 1;
    all.push_back({tilt * all[i][0], -(tilt * all[i][1]), sign * (tilt * all[i][2])});
  }
  return all;
}

Motion turning_motion(const EulerAxes& axes, const std::vector<Vec3>& rows, AngleUnit unit) {
  Motion motion;
  Joint joint;
  joint.name = "j";
  for (std::size_t k = 0; k < 3; ++k) {
    joint.dofs.push_back({DofKind::Rotation, axes[k], k, 0});
    motion.skeleton.coordinates.push_back({0, "angle" + std::to_string(k)});
  }
  motion.skeleton.joints = {joint};
  motion.skeleton.angle_unit = unit;
  motion.clip.num_frames = rows.size();
  motion.clip.num_coordinates = 3;
  for (const Vec3& row : rows) {
    motion.clip.values.append({row[0], row[1], row[2]});
  }
  return motion;
}

Motion free_motion(const std::vector<std::vector<double>>& rows) {
  Motion motion;
  Joint joint;
  joint.name = "base";
  joint.dofs = {{DofKind::Free, Vec3::UnitX(), 0, 0}};
  motion.skeleton.joints = {joint};
  for (const char* channel : {"x", "y", "z", "qw", "qx", "qy", "qz"}) {
    motion.skeleton.coordinates.push_back({0, channel});
  }
  motion.clip.num_frames = rows.size();
  motion.clip.num_coordinates = 7;
  for (const auto& row : rows) {
    motion.clip.values.append(row);
  }
  return motion;
}

retime::TimeMap constant_rate(std::size_t num_frames, double rate) {
  retime::TimeMap map;
  for (std::size_t n = 0; n < num_frames; ++n) {
    map.old_frames.push_back(rate * static_cast<double>(n));
  }
  return map;
}

Motion retimed(const Motion& motion, const retime::TimeMap& map,
               const retime::RetimeOptions& options) {
  Diagnostics diagnostics;
  auto result = retime::apply(motion, map, options, diagnostics);
  EXPECT_TRUE(result);
  for (const Diagnostic& diagnostic : diagnostics.items()) ADD_FAILURE() << to_string(diagnostic);
  return result ? std::move(*result) : Motion{};
}

double largest_step(const Clip& clip) {
  double largest = 0;
  for (std::size_t f = 1; f < clip.num_frames; ++f) {
    for (std::size_t c = 0; c < clip.num_coordinates; ++c) {
      largest = std::max(largest, std::abs(clip.row(f)[c] - clip.row(f - 1)[c]));
    }
  }
  return largest;
}

LeaveOutError leave_out_error(const Motion& motion, std::size_t step,
                              const retime::RetimeOptions& options) {
  std::vector<double> kept;
  for (std::size_t f = 0; f < motion.clip.num_frames; f += step) {
    kept.push_back(static_cast<double>(f));
  }
  const Motion sparse = retimed(motion, {kept});
  const std::size_t num_frames = (kept.size() - 1) * step + 1;
  const Motion guess =
      retimed(sparse, constant_rate(num_frames, 1 / static_cast<double>(step)), options);
  const KinematicsOptions all{.rotations = true};
  const WorldPoses expected = forward_kinematics(motion.skeleton, motion.clip, all);
  const WorldPoses found = forward_kinematics(guess.skeleton, guess.clip, all);
  LeaveOutError error;
  double count = 0;
  for (std::size_t i = 0; i < num_frames * found.num_joints; ++i) {
    if (i / found.num_joints % step == 0) continue;
    const auto rotation = [i](const WorldPoses& poses) {
      const double* q = &poses.rotations[4 * i];
      return Quat(q[0], q[1], q[2], q[3]);
    };
    const auto position = [i](const WorldPoses& poses) {
      return Vec3(poses.positions[3 * i], poses.positions[3 * i + 1], poses.positions[3 * i + 2]);
    };
    error.degrees += angle_between(rotation(expected), rotation(found)) / kRadiansPerDegree;
    error.distance += (position(expected) - position(found)).norm();
    ++count;
  }
  error.degrees /= count;
  error.distance /= count;
  return error;
}

}  // namespace kinefile::test
