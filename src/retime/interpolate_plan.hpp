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
  std::array<DegreeOfFreedom, 3> rotations;  ///< outermost first
  simd::EulerForm form;
};

/// A rotation that several columns tell as a whole: a ball or a rotation vector, or the quaternion
/// of a free joint as a ball.
struct WholeRotation {
  DegreeOfFreedom dof;
  AngleUnit unit;
};

/// Which columns of a clip are interpolated how. Every column is in one of the three.
struct InterpolationPlan {
  std::vector<TurningJoint> turning_joints;
  std::vector<WholeRotation> whole_rotations;
  std::vector<std::size_t> number_columns;
};

/// Sorts the columns by how they are interpolated. Notes the joints whose rotations are
/// interpolated angle by angle though they have three or more (RTM007).
InterpolationPlan plan_interpolation(const Skeleton& skeleton, RotationInterpolation rotation,
                                     Diagnostics& diagnostics);

}  // namespace kinefile::retime
