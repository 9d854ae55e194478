// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "kinefile/body_motion.hpp"
#include "kinefile/edit.hpp"

namespace kinefile {

/// Joins a motion with the one that follows it, which is null if it is repeated.
/// \param is_moved  whether the parts are places in the world, which move on the ground
using JoinMotions =
    std::function<Result<Motion>(Motion first, const Motion* second, bool is_moved)>;

/// Joins the components of a body motion with those of another, or repeats them. Components that
/// hold places in the world (see `robot::is_in_world`) are one motion with z up, so that all move
/// on the ground as the first link does; each other component is blended as it is.
/// \param next  the body motion that follows; null: none
/// \errors CLI002 (Usage) if the components of one of them do not have one length and rate; EDT005
///         (Usage) if the two do not have the same components; those of `join`
Result<void> join_components(BodyMotion& body, const BodyMotion* next, const JoinMotions& join);

}  // namespace kinefile
