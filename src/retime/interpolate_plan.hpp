// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "kinefile/retime.hpp"
#include "simd/angles.hpp"
#include "simd/slerp.hpp"

namespace kinefile::retime {

/// A joint whose three angles are interpolated as one rotation.
struct TurningJoint {
  std::array<DegreeOfFreedom, 3> rotations;  ///< outermost first
  simd::EulerForm form;
};

/// A whole rotation from several columns: a ball or a rotation vector, or the quaternion of a free
/// joint as a ball.
struct WholeRotation {
  DegreeOfFreedom dof;
  AngleUnit unit;
};

/// How the columns of a clip are interpolated. Every column is in one of the three.
struct InterpolationPlan {
  std::vector<TurningJoint> turning_joints;
  std::vector<WholeRotation> whole_rotations;
  std::vector<std::size_t> number_columns;
  std::vector<double> turns;  ///< of `turns_of_columns`; shape (coordinates)
};

/// Sorts the columns by how they are interpolated. A note reports joints with three or more
/// rotations that are interpolated angle by angle (RTM007).
InterpolationPlan plan_interpolation(const Skeleton& skeleton, RotationInterpolation rotation,
                                     Diagnostics& diagnostics);

}  // namespace kinefile::retime
