// SPDX-License-Identifier: MIT
#pragma once

#include "simd/forward_kinematics.hpp"

namespace kinefile::simd {

/// `place_frames` for plans that have quaternions. Errors are a few times the rounding error of the
/// largest coordinate. Every instruction set gives the same bits.
void place_by_quaternions(const Plan& plan, Frame frame, const Rows& rows,
                          const PoseOutput<double>& out);
void place_by_quaternions(const Plan& plan, Frame frame, const Rows& rows,
                          const PoseOutput<float>& out);

}  // namespace kinefile::simd
