// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "simd/block.hpp"

namespace kinefile::simd {

/// A place between two quaternions.
struct Between {
  std::size_t from;
  std::size_t to;
  double t;  ///< 0 at `from`, 1 at `to`
};

/// Interpolates between unit quaternions as `kinefile::slerp` and `kinefile::nlerp` do; the results
/// are not normalised.
/// \param places  padded to a multiple of kBlock
void slerp(const Quaternions& quaternions, const std::vector<Between>& places, Quaternions& out);
void nlerp(const Quaternions& quaternions, const std::vector<Between>& places, Quaternions& out);

/// The quaternions before and after one on a curve, or itself if there is none.
struct Neighbours {
  std::size_t before;
  std::size_t after;
};

/// The inner control points of a curve through unit quaternions, as `kinefile::squad_control` finds
/// them; the quaternion itself if a neighbour is missing.
/// \param neighbours  of each quaternion, padded
void squad_controls(const Quaternions& quaternions, const std::vector<Neighbours>& neighbours,
                    Quaternions& controls);

/// Interpolates on a curve as `kinefile::squad` does; the results are not normalised.
void squad(const Quaternions& quaternions, const Quaternions& controls,
           const std::vector<Between>& places, Quaternions& out);

}  // namespace kinefile::simd
