// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kinefile/array.hpp"
#include "kinefile/diagnostics.hpp"
#include "kinefile/pose_flow.hpp"
#include "kinefile/result.hpp"
#include "kinefile/robot_project.hpp"

#pragma GCC visibility push(default)

namespace kinefile::flow {

/// The value of a slider whose word is disabled (0X).
enum class DisabledWords {
  Base,  ///< the value of the base pose, as in the editor
  Keep,  ///< its current value
  File,  ///< the word in the file
};

/// An input of a person or a sensor: it holds from a tick on.
struct Input {
  std::uint64_t tick = 0;
  std::optional<bool> is_held;  ///< whether the motion's button is pressed
  std::vector<std::pair<std::size_t, std::int16_t>> variables;  ///< number and value
};

/// How to run a flow. There is an option for each behaviour that the format's document leaves open.
struct RunOptions {
  std::vector<std::int16_t> base_pose;  ///< by slider; if shorter, the others are 0
  std::vector<bool> jumps;      ///< sliders that take new values at once, without interpolation;
                                ///< empty: 30 and 37 to 40
  std::uint64_t num_loops = 0;  ///< how often each loop block (WORD_N: each pose with a break)
                                ///< follows its normal arrow before it takes its branch
  std::optional<std::uint64_t> hold_ticks;  ///< how long the button is held; replaces `num_loops`
  std::vector<std::pair<std::size_t, std::int16_t>> variables;  ///< values at the start
  std::vector<Input> inputs;  ///< sorted by tick; if any sets `is_held`, this replaces `num_loops`
  DisabledWords disabled = DisabledWords::Base;
  bool true_takes_branch = true;        ///< branch blocks take the branch if their condition is
                                        ///< true; otherwise the normal arrow
  bool skips_division_by_zero = false;  ///< the variable keeps its value; otherwise an error
  std::uint64_t max_ticks = 216'000;    ///< one hour at 60 ticks per second
};

/// The options that a project specifies: the base pose and the sliders that jump.
RunOptions run_options_of(const RobotProject& project);

/// The block that was entered at a tick.
struct Step {
  std::uint64_t tick = 0;
  std::size_t block = 0;
  std::int16_t value = 0;     ///< of an arithmetic block the result; of a branch block its variable
  bool takes_branch = false;  ///< left by the branch arrow; for a pose WORD_N's break
};

/// A change of sound or servo power: when a pose begins, or when another block changes variables 62
/// and 63.
struct Event {
  std::uint64_t tick = 0;
  std::size_t block = 0;
  std::string sound;                  ///< the sound that starts; empty: none
  std::bitset<kNumServos> servo_off;  ///< servos without power from now on
  bool changes_servos = false;        ///< whether `servo_off` differs from before
};

enum class End {
  EndBlock,  ///< an end block; WORD_N: a pose without next
  NoArrow,   ///< an arrow that leads nowhere
  MaxTicks,  ///< the time limit `RunOptions::max_ticks`
};

/// The result of a run: sliders at every tick from 0 on.
struct Run {
  std::size_t num_sliders = 0;
  std::size_t num_ticks = 0;    ///< its duration; `sliders` has one row more
  Array<std::int16_t> sliders;  ///< [tick][slider], `num_ticks + 1` rows
  std::vector<Step> path;
  std::vector<Event> events;
  std::array<std::int16_t, kNumVariables> variables = {};  ///< at the end
  End end = End::EndBlock;
};

/// Runs a flow tick by tick. The result is deterministic, and every run ends.
/// Sliders move to a pose linearly, in integers: from + trunc((to - from) k / n) at tick k of n.
/// Arithmetic uses 16 bits; overflow wraps around, with a warning (RUN002).
/// Precondition: arrows lead to blocks or to `kNoBlock`, poses have a word for every slider, and
/// numbers of variables are below `kNumVariables`.
/// \errors RUN001 (InvalidInput) for a division by zero, RUN003 for a cycle of blocks without a
///         pose, RUN004 if there is no first block; each at the line of its block
/// Source: docs/formats/robovie.md, "How a flow runs", which marks our inferences.
Result<Run> run(const PoseFlow& flow, const RunOptions& options, Diagnostics& diagnostics);

/// The flow as Graphviz DOT, with the editor's layout; loops, branches and unreachable blocks are
/// marked.
std::string graph(const PoseFlow& flow);

/// The same flow in the given format; unchanged if it has that format already.
/// \errors FLW001 (DataLoss) with the reason, if WORD_N cannot express the flow
Result<PoseFlow> in_format(const PoseFlow& flow, FlowFormat format, Diagnostics& diagnostics);

/// Which slider gets a slider's value when a flow is mirrored, and with which sign.
struct MirrorPair {
  std::size_t slider = 0;
  std::size_t partner = 0;  ///< the slider itself if it is on the centre line
  int sign = -1;
};

/// The pairs of a project (_PAIR) among a flow's first sliders. Signs are -1, as on the
/// manufacturer's robots; a project does not specify them.
std::vector<MirrorPair> mirror_pairs_of(const RobotProject& project, std::size_t num_sliders);

/// What the poses of a flow show about the sign of a pair. A pose shows it if it displaces both
/// sides from the base pose by as much: by more than a 64th of the slider's range, and alike within
/// a 16th or one step. The sign is 1 if they are displaced alike, -1 if they are opposite. Under
/// that sign the mirrored pose has the same words; under the other one it has words that the flow
/// never has.
struct SignEvidence {
  std::optional<std::size_t> alike_block = std::nullopt;     ///< the first pose that shows 1
  std::optional<std::size_t> opposite_block = std::nullopt;  ///< the first pose that shows -1
  /// Two of the poses that show a sign displace the sides by different sizes, or one of them is
  /// symmetric as a whole: the sides of every pair are displaced by as much, and no centre slider
  /// is displaced.
  bool is_clear = false;
  bool moves = false;  ///< some pose displaces one of the sides
};

/// The evidence for each pair; shape (pairs).
/// \param pairs  of `mirror_pairs_of` for the project and the flow
std::vector<SignEvidence> sign_evidence(const PoseFlow& flow, const RobotProject& project,
                                        const std::vector<MirrorPair>& pairs);

/// The mirrored flow: poses swap the words of pairs, and the power states of the servos with the
/// same numbers. -32768 becomes 32767, with a note.
/// \errors FLW002 (Usage) if a slider is in two pairs or the flow does not have it
Result<PoseFlow> mirror(const PoseFlow& flow, const std::vector<MirrorPair>& pairs,
                        Diagnostics& diagnostics);

/// The poses of a straight flow in reverse order. The times between poses are reversed, too.
/// \errors FLW003 (Usage) if it loops, branches or computes
Result<PoseFlow> reverse(const PoseFlow& flow);

/// All times divided by a factor, rounded. A pose longer than 239 ticks is split along its line;
/// one shorter than a tick gets one tick, with a note.
/// \errors FLW004 (Usage) if the factor is not above 0, or the flow would be too long
Result<PoseFlow> speed(const PoseFlow& flow, double factor, Diagnostics& diagnostics);

/// Adds to the words of a slider in all poses that enable it.
/// \errors FLW005 (Usage) if there is no such slider, or a word does not fit into 16 bits
Result<PoseFlow> offset(const PoseFlow& flow, std::size_t slider, int offset);

/// Replaces sliders with those of another flow with equally many poses: words and whether they are
/// enabled, pose by pose in the order of their blocks.
/// \errors FLW006 (Usage) if the numbers of poses differ or a slider does not exist
Result<PoseFlow> merge(const PoseFlow& flow, const PoseFlow& other,
                       const std::vector<std::size_t>& sliders);

/// Inserts the poses of a straight flow after a block, on its normal arrow; all arrows are
/// renumbered.
/// \errors FLW003 if `other` is not straight; FLW007 (Usage) if there is no such block
Result<PoseFlow> insert(const PoseFlow& flow, std::size_t block, const PoseFlow& other);

/// Removes a block; arrows to it then lead to the target of its normal arrow, and all arrows are
/// renumbered.
/// \errors FLW007 (Usage) if there is no such block or it is the start
Result<PoseFlow> erase(const PoseFlow& flow, std::size_t block);

}  // namespace kinefile::flow

#pragma GCC visibility pop
