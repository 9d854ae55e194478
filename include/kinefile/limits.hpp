// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "kinefile/motion.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// A joint that exceeds a limit of position or speed.
struct LimitBreach {
  enum class Kind { Below, Above, TooFast };
  Kind kind = Kind::Below;
  std::size_t joint = 0;
  std::size_t dof = 0;          ///< the index among the joint's degrees of freedom
  std::size_t first_frame = 0;  ///< for TooFast: the later of the two frames
  std::size_t num_frames = 0;   ///< how many frames are beyond the limit
  double worst = 0;             ///< the value furthest beyond the limit, or the highest speed per
                                ///< second
  std::size_t worst_frame = 0;
  double limit = 0;
};

/// Finds the joints of a motion that leave the limits of their degrees of freedom: one entry per
/// degree of freedom and kind of breach, in skeleton order. Values that are not finite are skipped.
std::vector<LimitBreach> find_limit_breaches(const Motion& motion);

/// Which limit of position a value of a degree of freedom exceeds, by more than rounding; nothing:
/// none.
std::optional<LimitBreach::Kind> breach_of(const DegreeOfFreedom& dof, double value);

/// The unit in which people are told the values of a degree of freedom.
struct ToldUnit {
  double factor = 1;      ///< of a value in the skeleton's unit
  std::string_view name;  ///< "deg", "m", or "units": of the file, whose size is not known; empty
                          ///< for a scale
};

/// Angles in degrees, lengths in metres where the skeleton says its unit of length.
/// Precondition: the degree of freedom reads one column.
ToldUnit told_unit(const DegreeOfFreedom& dof, const Skeleton& skeleton);

}  // namespace kinefile

#pragma GCC visibility pop
