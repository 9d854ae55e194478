// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "kinefile/process.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// The motion of a document in the world.
struct Placed {
  Motion motion;          ///< of a skeleton alone: without frames
  bool is_still = false;  ///< the document is a skeleton alone
  /// The body motion that was put on a robot: its recorded links are nearer to the truth than what
  /// kinematics finds (see `robot::put_recorded_links`).
  std::optional<BodyMotion> recorded = std::nullopt;
};

/// Places a document in the world: a motion as it is, a body motion on its robot or by its links.
/// \param robot    what a body motion is put on (see `robot::pose`); where there is none, its links
///                 stand where they were recorded (see `robot::motion_of_links`)
/// \param lenient  for `robot::pose`
/// \errors CLI001 (Usage) for a flow of poses; those of `robot` and of these two functions; DOC001
///         (Usage) if what `robot` gives has no skeleton
Result<Placed> place(const Document& document, const DocumentSource& robot, bool lenient,
                     Diagnostics& diagnostics);

}  // namespace kinefile

#pragma GCC visibility pop
