// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/run.hpp"

// A flow of servo poses without a robot: nothing of it has a place, but its sliders have values.
namespace kinefile::page {

/// A motion of one joint that stands still, with a column for each slider that a pose sets.
/// \param project  gives names and degrees of sliders; null: "s3", and words
Motion motion_of_sliders(const TimedRun& timed, const PoseFlow& flow, const RobotProject* project);

}  // namespace kinefile::page
