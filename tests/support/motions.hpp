// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "kinefile/retime.hpp"

namespace kinefile::test {

/// The twelve orders of axes about x, y and z, and as many about other axes, some of them opposite.
std::vector<EulerAxes> all_euler_axes();

/// A motion of one joint 'j' that turns about three axes; a row a frame.
Motion turning_motion(const EulerAxes& axes, const std::vector<Vec3>& rows,
                      AngleUnit unit = AngleUnit::Degrees);

/// A motion of one free joint; rows of seven numbers.
Motion free_motion(const std::vector<std::vector<double>>& rows);

/// The map n -> rate n.
retime::TimeMap constant_rate(std::size_t num_frames, double rate);

/// Retimes a motion, which must succeed without a diagnostic.
Motion retimed(const Motion& motion, const retime::TimeMap& map,
               const retime::RetimeOptions& options = {});

/// The largest change of a value from one frame to the next.
double largest_step(const Clip& clip);

/// How far the frames that were left out are from the true ones: means over joints and frames.
struct LeaveOutError {
  double degrees = 0;   ///< of the rotations in the world
  double distance = 0;  ///< of the positions, in the skeleton's unit
};

/// Keeps every `step`th frame of a motion and interpolates the others.
LeaveOutError leave_out_error(const Motion& motion, std::size_t step,
                              const retime::RetimeOptions& options);

}  // namespace kinefile::test
