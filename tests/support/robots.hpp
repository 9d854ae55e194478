// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "kinefile/process.hpp"

namespace kinefile::test {

/// A robot: a root BASE that moves freely and HINGE half a metre along x, which turns about z from
/// -1 to 1 radians, at up to 2 a second.
Skeleton hinge_robot();

/// A body motion at ten frames a second: the root stands at (1, 2, 3), the hinge has these angles.
BodyMotion hinge_motion(const std::vector<double>& angles);

/// A source that gives a document.
DocumentSource source_of(Document document);

/// A source that fails with IO001.
DocumentSource source_that_fails();

}  // namespace kinefile::test
