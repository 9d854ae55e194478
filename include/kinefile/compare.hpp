// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kinefile/motion.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// The largest of some differences, and where it is.
struct LargestDifference {
  double value = 0;
  std::string joint;      ///< empty if nothing was compared
  std::size_t frame = 0;  ///< of the first motion
  double time = 0;        ///< seconds
};

/// How two motions differ in the world.
struct MotionComparison {
  LargestDifference distance;              ///< between joints, in the first motion's unit of length
  LargestDifference tip_distance;          ///< between tips, for joints that have equally many in
                                           ///< both
  LargestDifference rotation;              ///< between joints, in degrees
  std::vector<std::string> only_in_first;  ///< joints that the second does not have
  std::vector<std::string> only_in_second;
  std::vector<std::string> other_tips;  ///< joints whose numbers of tips differ, so that their tips
                                        ///< were not compared
  std::size_t num_frames_first = 0;
  std::size_t num_frames_second = 0;
};

/// Compares the positions and rotations of joints of two motions in the world. Joints are matched
/// by name, repeated names in their order. Each frame of the first is compared with the frame of
/// the second that is nearest in time. Motions without frames are compared in their rest poses. If
/// exactly one of two numbers is NaN, they differ by infinity. If both specify their units of
/// length, the lengths of the second are converted.
MotionComparison compare_motions(const Motion& first, const Motion& second);

}  // namespace kinefile

#pragma GCC visibility pop
