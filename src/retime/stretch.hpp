// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "kinefile/result.hpp"
#include "retime/curves.hpp"

namespace kinefile::retime {

/// Inserts knots between keys (x: new frames, y: old ones), so that linear pieces from knot to knot
/// stretch time by weights: dn/ds = 1 + c(s) k in every interval, where c is linear between the
/// weights of neighbouring old frames and k is such that the keys are met.
/// Between whole old frames the rate is that of their mean weight, so that the map can be
/// inverted piece by piece; at whole old frames it is exact.
/// \param weights  one per old frame, none negative
/// \errors RTM001 if an interval changes its length where all weights are 0, or would run backwards
Result<std::vector<Knot>> stretched_knots(const std::vector<Knot>& keys,
                                          const std::vector<double>& weights);

}  // namespace kinefile::retime
