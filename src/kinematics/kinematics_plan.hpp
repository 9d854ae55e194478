// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "kinefile/kinematics.hpp"
#include "simd/forward_kinematics.hpp"

namespace kinefile {

struct Kinematics::Plan {
  simd::Plan joints;
  std::size_t num_coordinates = 0;
  std::size_t num_tips = 0;
  double radians_per_unit = 1;  ///< of an angle unit
};

/// A rotation about one axis in the form that the kernels need.
simd::Turn plan_turn(const DegreeOfFreedom& dof);

}  // namespace kinefile
