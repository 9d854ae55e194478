// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kinefile/diagnostics.hpp"
#include "kinefile/motion.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// A place in a motion that deserves a look, for a timeline and for `check`.
struct Mark {
  enum class Kind {
    Spike,       ///< the joint turns suddenly and turns back (see `find_sudden_turns`)
    Flip,        ///< the joint turns suddenly and does not turn back
    BelowLimit,  ///< a degree of freedom is below its range (see `find_limit_breaches`)
    AboveLimit,  ///< above its range
    TooFast,     ///< faster than its highest speed
  };
  Kind kind = Kind::Spike;
  Severity severity = Severity::Note;
  std::size_t joint = 0;
  std::size_t first_frame = 0;  ///< of a sudden turn: the first frame after it
  /// Of a spike: the frames until the joint has turned back; of a flip: 1. Of a limit: how many
  /// frames are beyond it from `first_frame` on; there may be others between them.
  std::size_t num_frames = 0;
  std::size_t worst_frame = 0;  ///< the frame to show; of a sudden turn: `first_frame`
  std::string code = {};        ///< of the diagnostic: "MOT001"
  std::string message = {};     ///< one sentence: "joint 'Head' turns by 170 degrees ..."
};

/// Finds sudden turns, sorted by joint, then frame, and after them what `find_limit_marks` finds.
std::vector<Mark> find_marks(const Motion& motion);

/// Finds the joints that leave the limits of their degrees of freedom, in skeleton order: of a
/// robot, a warning per degree of freedom and kind; of a figure, whose limits are often narrower
/// than the person's, a note per joint and kind for the worst of its degrees of freedom.
std::vector<Mark> find_limit_marks(const Motion& motion);

}  // namespace kinefile

#pragma GCC visibility pop
