// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "kinefile/result.hpp"
#include "retime/curves.hpp"

namespace kinefile::retime {

/// Puts knots between keys (x: new frames, y: old ones), so that straight pieces from knot to knot
/// stretch time as weights say: dn/ds = 1 + c(s) k in every interval, where c runs straight from
/// one old frame's weight to the next's and k is such that the keys are met.
/// Between whole old frames the rate is that of their mean weight, so that the map can be
/// inverted piece by piece; at whole old frames it is exact.
/// \param weights  one an old frame, none negative
/// \errors RTM001 if an interval changes its length where no weight lets it, or would run back
Result<std::vector<Knot>> stretched_knots(const std::vector<Knot>& keys,
                                          const std::vector<double>& weights);

}  // namespace kinefile::retime
