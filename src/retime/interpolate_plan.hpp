// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "kinefile/retime.hpp"
#include "simd/slerp.hpp"

namespace kinefile::retime {

/// A joint whose three angles are interpolated as the rotation that they make.
struct TurningJoint {
  std::array<std::size_t, 3> columns;  ///< of the rotations, outermost first
  simd::EulerForm form;
};

/// A free joint's quaternion: the column of qw; qx, qy, qz follow.
struct FreeRotation {
  std::size_t first_column;
};

/// Which columns of a clip are interpolated how. Every column is in one of the three.
struct InterpolationPlan {
  std::vector<TurningJoint> turning_joints;
  std::vector<FreeRotation> free_rotations;
  std::vector<std::size_t> number_columns;
};

/// Sorts the columns by how they are interpolated. Notes the joints whose rotations are
/// interpolated angle by angle though they have three or more (RTM007).
InterpolationPlan plan_interpolation(const Skeleton& skeleton, RotationInterpolation rotation,
                                     Diagnostics& diagnostics);

}  // namespace kinefile::retime
