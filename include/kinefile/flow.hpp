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

/// What becomes of a slider whose word says that it is disabled (0X).
enum class DisabledWords {
  Base,  ///< it takes the base pose's value, as the editor does
  Keep,  ///< it stays where it is
  File,  ///< it takes the word
};

/// What a person or a sensor does at a tick, and from then on.
struct Input {
  std::uint64_t tick = 0;
  std::optional<bool> is_held;  ///< whether the motion's button is pressed
  std::vector<std::pair<std::size_t, std::int16_t>> variables;  ///< number and value
};

/// How to run a flow. What the format's document leaves open has a switch each.
struct RunOptions {
  std::vector<std::int16_t> base_pose;  ///< by slider; shorter: the rest are 0
  std::vector<bool> jumps;      ///< sliders that take new values at once; empty: 30 and 37 to 40
  std::uint64_t num_loops = 0;  ///< how often each loop block goes its normal way (of WORD_N: each
                                ///< pose with a break) before it leaves
  std::optional<std::uint64_t> hold_ticks;  ///< the button is held so long, instead
  std::vector<std::pair<std::size_t, std::int16_t>> variables;  ///< at the start
  std::vector<Input> inputs;  ///< by tick, none earlier than the one before; where one says
                              ///< `is_held`, it stands instead of `num_loops`
  DisabledWords disabled = DisabledWords::Base;
  bool true_takes_branch = true;        ///< of branch blocks; else the normal way
  bool skips_division_by_zero = false;  ///< leaves the variable; else an error
  std::uint64_t max_ticks = 216'000;    ///< an hour at 60 ticks a second
};

/// What a project says of running a flow: the base pose and the sliders that jump.
RunOptions run_options_of(const RobotProject& project);

/// The block that was entered at a tick.
struct Step {
  std::uint64_t tick = 0;
  std::size_t block = 0;
  std::int16_t value = 0;     ///< of arithmetic the result; of a branch block its variable
  bool takes_branch = false;  ///< left by the branch arrow; of a pose that is WORD_N's break
};

/// What else happens: when a pose begins, or when variables 62 and 63 change otherwise.
struct Event {
  std::uint64_t tick = 0;
  std::size_t block = 0;
  std::string sound;                  ///< starts; empty: none
  std::bitset<kNumServos> servo_off;  ///< from now on
  bool changes_servos = false;        ///< whether `servo_off` differs from before
};

enum class End {
  EndBlock,  ///< of WORD_N: a pose without next
  NoArrow,   ///< an arrow that leads nowhere
  MaxTicks,  ///< the limit of time
};

/// What a robot did: sliders at every tick from 0 on.
struct Run {
  std::size_t num_sliders = 0;
  std::size_t num_ticks = 0;    ///< its duration; there is a row more
  Array<std::int16_t> sliders;  ///< [tick][slider], `num_ticks + 1` rows
  std::vector<Step> path;
  std::vector<Event> events;
  std::array<std::int16_t, kNumVariables> variables = {};  ///< at the end
  End end = End::EndBlock;
};

/// Runs a flow tick by tick: always with the same result, and always with an end.
/// Sliders go to a pose on a line, in whole numbers: from + trunc((to - from) k / n) at tick k of
/// n. Arithmetic is in 16 bits and wraps around, with a warning (RUN002).
/// Precondition: arrows lead to blocks or to `kNoBlock`, poses have a word for every slider, and
/// numbers of variables are below `kNumVariables`.
/// \errors RUN001 (InvalidInput) for a division by zero, RUN003 for blocks that go round without a
///         pose, RUN004 if there is no block to begin with; each at the line of its block
/// Source: docs/formats/robovie.md, "How a flow runs", which marks what is our inference.
Result<Run> run(const PoseFlow& flow, const RunOptions& options, Diagnostics& diagnostics);

/// The flow as Graphviz DOT, placed as the editor draws it; loops, branches and blocks that no way
/// leads to are marked.
std::string graph(const PoseFlow& flow);

/// The same flow in the other format, or as it is.
/// \errors FLW001 (DataLoss) with the reason, if a flow cannot be said in WORD_N
Result<PoseFlow> in_format(const PoseFlow& flow, FlowFormat format, Diagnostics& diagnostics);

/// Which slider shows a slider's value in a mirror, and with which sign.
struct MirrorPair {
  std::size_t slider = 0;
  std::size_t partner = 0;  ///< itself for one on the centre line
  int sign = -1;
};

/// The pairs of a project (_PAIR) among a flow's first sliders. Signs are -1, as on the maker's own
/// robots; the project has no word for them.
std::vector<MirrorPair> mirror_pairs_of(const RobotProject& project, std::size_t num_sliders);

/// Of pairs of negative sign those whose words are alike in some pose, and opposite in none: such
/// joints may well turn alike on both sides, and keep their sign in a mirror.
std::vector<MirrorPair> doubtful_pairs(const PoseFlow& flow, const std::vector<MirrorPair>& pairs);

/// The flow in a mirror: poses swap the words of pairs, and whether the servos of the same numbers
/// have power. -32768 becomes 32767, with a note.
/// \errors FLW002 (Usage) if a slider is in two pairs or is none of the flow
Result<PoseFlow> mirror(const PoseFlow& flow, const std::vector<MirrorPair>& pairs,
                        Diagnostics& diagnostics);

/// The poses of a flow that goes straight on, from the last to the first, with times that fit.
/// \errors FLW003 (Usage) if it loops, branches or computes
Result<PoseFlow> reverse(const PoseFlow& flow);

/// All times divided by a factor, rounded; a pose longer than 239 ticks is split on its line, one
/// shorter than a tick takes one, with a note.
/// \errors FLW004 (Usage) if the factor is not above 0, or the flow would be too long
Result<PoseFlow> speed(const PoseFlow& flow, double factor, Diagnostics& diagnostics);

/// Adds to the words of a slider in all poses that enable it.
/// \errors FLW005 (Usage) if there is no such slider, or a word leaves 16 bits
Result<PoseFlow> offset(const PoseFlow& flow, std::size_t slider, int offset);

/// Takes sliders from another flow with as many poses on its way: words and whether they are
/// enabled, pose by pose in the order of their blocks.
/// \errors FLW006 (Usage) if the numbers of poses differ or a slider is none
Result<PoseFlow> merge(const PoseFlow& flow, const PoseFlow& other,
                       const std::vector<std::size_t>& sliders);

/// Puts the poses of a straight flow after a block, on its normal way; all arrows are renumbered.
/// \errors FLW003 if `other` is not straight; FLW007 (Usage) if there is no such block
Result<PoseFlow> insert(const PoseFlow& flow, std::size_t block, const PoseFlow& other);

/// Takes out a block; arrows to it go where its normal way went, and all are renumbered.
/// \errors FLW007 (Usage) if there is no such block or it is the start
Result<PoseFlow> erase(const PoseFlow& flow, std::size_t block);

}  // namespace kinefile::flow

#pragma GCC visibility pop
