// SPDX-License-Identifier: MIT
#include "formats/quaternion_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace kinefile {
namespace {

constexpr std::size_t kPoseWidth = 7;
constexpr std::size_t kPositionWidth = 3;

/// Three digits after the point give this much.
constexpr double kRoundedLength = 1e-3;

void add_fault(QuaternionFault& fault, const QuaternionFault& found) {
  if (fault.count == 0) fault = found;
  ++fault.count;
}

/// Where the first of some quaternions is, in words.
std::string words_of_place(const QuaternionFault& fault, std::string_view content) {
  std::string words = fmt::format("pose {} of {} in frame {}", fault.part, content, fault.frame);
  if (fault.count > 1) words += fmt::format(", the first of {}", fault.count);
  return words;
}

}  // namespace

void look_at_quaternions(std::span<const double> poses, std::size_t frame, const char* at,
                         QuaternionFaults& faults) {
  for (std::size_t part = 0; (part + 1) * kPoseWidth <= poses.size(); ++part) {
    const double* q = poses.data() + part * kPoseWidth + kPositionWidth;
    const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    if (std::abs(square - 1) <= kRoundedLength) continue;
    if (!std::all_of(q, q + 4, [](double number) { return std::isfinite(number); })) continue;
    // hypot does not overflow where the squares do.
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (std::abs(length - 1) <= kRoundedLength) continue;
    add_fault(length == 0 ? faults.of_no_length : faults.of_other_length,
              {0, frame, part, length, at});
  }
}

void tell_quaternion_faults(const text::Source& source, const QuaternionFaults& faults,
                            std::string_view content, const QuaternionCodes& codes,
                            Diagnostics& diagnostics) {
  const QuaternionFault& none = faults.of_no_length;
  if (none.count > 0) {
    text::report(source, diagnostics, Severity::Warning, codes.no_length,
                 fmt::format("expected a quaternion of length 1, found one of length 0 ({}); it "
                             "is read as no rotation",
                             words_of_place(none, content)),
                 none.at);
  }
  const QuaternionFault& other = faults.of_other_length;
  if (other.count > 0) {
    text::report(source, diagnostics, Severity::Warning, codes.other_length,
                 fmt::format("expected a quaternion of length 1, found one of length {:.6g} ({}); "
                             "it is normalised where poses are computed",
                             other.length, words_of_place(other, content)),
                 other.at);
  }
}

}  // namespace kinefile
