// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "kinefile/process.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// The motion of a document in the world.
struct Placed {
  Motion motion;          ///< for a skeleton alone: without frames
  bool is_still = false;  ///< the document is a skeleton alone
  /// The body motion that was applied to a robot: its recorded link poses are more accurate than
  /// those of kinematics (see `robot::put_recorded_links`).
  std::optional<BodyMotion> recorded = std::nullopt;
};

/// Places a document in the world: a motion unchanged, a body motion on its robot or by its links.
/// \param robot    the robot that a body motion is applied to (see `robot::pose`); without one, its
///                 links are placed as recorded (see `robot::motion_of_links`)
/// \param lenient  for `robot::pose`
/// \errors CLI001 (Usage) for a flow of poses; those of `robot` and of these two functions; DOC001
///         (Usage) if the document from `robot` has no skeleton
Result<Placed> place(const Document& document, const DocumentSource& robot, bool lenient,
                     Diagnostics& diagnostics);

}  // namespace kinefile

#pragma GCC visibility pop
