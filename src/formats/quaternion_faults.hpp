// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "kinefile/diagnostics.hpp"
#include "text/source.hpp"

namespace kinefile {

/// Quaternions of a file that have one fault: how many, and the first of them.
struct QuaternionFault {
  std::size_t count = 0;
  std::size_t frame = 0;
  std::size_t part = 0;
  double length = 0;
  const char* at = nullptr;
};

/// What is wrong with the quaternions of some poses, found while they are read.
struct QuaternionFaults {
  QuaternionFault of_no_length;     ///< all four numbers are 0: no rotation
  QuaternionFault of_other_length;  ///< by more than a thousandth another length than 1
};

/// The codes of the messages of `tell_quaternion_faults`, which are warnings.
struct QuaternionCodes {
  const char* no_length;
  const char* other_length;
};

/// Looks at the quaternions of one frame. Numbers that are not finite are ignored: whoever reads
/// them reports them.
/// \param poses  seven numbers a part, the last four of them its quaternion, w first or last
/// \param at     the frame's place in the text
void look_at_quaternions(std::span<const double> poses, std::size_t frame, const char* at,
                         QuaternionFaults& faults);

/// Reports the first quaternion of each fault, with the count of the others.
/// \param content  of the component, for the message: "LinkPosition"
void tell_quaternion_faults(const text::Source& source, const QuaternionFaults& faults,
                            std::string_view content, const QuaternionCodes& codes,
                            Diagnostics& diagnostics);

}  // namespace kinefile
