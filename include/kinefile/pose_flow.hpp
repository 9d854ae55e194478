// SPDX-License-Identifier: MIT
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#pragma GCC visibility push(default)

namespace kinefile {

/// Which of RobovieMaker's two formats a flow has; they differ in what they can express.
enum class FlowFormat {
  WordN,  ///< POSEDEF_WORD_N, RobovieMaker for VS-RC003: only poses, each with next and break
  V1R4,   ///< POSEDEF_V1R4, RobovieMaker2: blocks of seven kinds
};

/// The longest time of a pose, in ticks.
inline constexpr int kMaxTicks = 239;
inline constexpr std::size_t kNumServos = 30;
/// How many variables a robot has; the first ones are the sliders.
inline constexpr std::size_t kNumVariables = 256;
/// No block: the target of an arrow that leads nowhere.
inline constexpr int kNoBlock = -1;

/// The maximum number of sliders of a flow: 64 (WORD_N) or 62 (V1R4).
constexpr std::size_t max_sliders(FlowFormat format) {
  return format == FlowFormat::V1R4 ? 62 : 64;
}

/// The word of the format's header: "POSEDEF_WORD_N" or "POSEDEF_V1R4".
constexpr std::string_view header_word(FlowFormat format) {
  return format == FlowFormat::V1R4 ? "POSEDEF_V1R4" : "POSEDEF_WORD_N";
}

/// The word of one slider in a pose: its actual value, in the units of that slider.
struct SliderWord {
  std::int16_t value = 0;
  /// Written 0x; 0X is a slider that was disabled when the file was saved.
  bool is_enabled = false;
  bool operator==(const SliderWord&) const = default;
};

struct StartBlock {
  bool operator==(const StartBlock&) const = default;
};

struct EndBlock {
  bool operator==(const EndBlock&) const = default;
};

/// Moves the sliders to their values in a given time.
struct PoseBlock {
  int ticks = 1;                      ///< 1 to `kMaxTicks`: the time to reach it
  std::vector<SliderWord> words;      ///< one per slider: `PoseFlow::num_sliders`
  std::string sound;                  ///< a path relative to the project; empty: none
  std::bitset<kNumServos> servo_off;  ///< by channel; 1 in the file: without power
  bool operator==(const PoseBlock&) const = default;
};

/// Follows the normal arrow while the motion's button is held, otherwise the branch.
struct LoopBlock {
  bool operator==(const LoopBlock&) const = default;
};

enum class Arithmetic { Assign, Add, Subtract, Multiply, Divide };

/// variable := variable operation operand.
struct ArithmeticBlock {
  int variable = 0;  ///< 0 to 255
  Arithmetic operation = Arithmetic::Assign;
  bool has_variable_operand = false;  ///< _VARVAR: `operand` is a variable's number
  int operand = 0;                    ///< otherwise a constant, -32768 to 32767
  bool operator==(const ArithmeticBlock&) const = default;
};

enum class Condition { Undefined, AtLeast, AtMost, BitsMatch, Equal, NotEqual, Always, Never };

/// Follows one of two arrows.
struct BranchBlock {
  int variable = 0;  ///< 0 to 255
  Condition condition = Condition::Undefined;
  /// A threshold; for `BitsMatch` the wanted bits in the high byte, their mask in the low byte.
  int detail = 0;
  bool operator==(const BranchBlock&) const = default;
};

using BlockBody =
    std::variant<StartBlock, EndBlock, PoseBlock, LoopBlock, ArithmeticBlock, BranchBlock>;

/// A block of a flow. Its number is its place in `PoseFlow::blocks`.
struct Block {
  std::string name;       ///< V1R4 only, as are the next four members
  int x = 0, y = 0;       ///< where the editor draws it
  int normal_turn = 6;    ///< the distance at which its normal arrow turns in the editor
  int branch_turn = 6;    ///< the same for its branch
  int normal = kNoBlock;  ///< the next block; WORD_N: "next"
  int branch = kNoBlock;  ///< the other next block of loops and branches; WORD_N: "break" of a pose
  BlockBody body;
  std::size_t line = 0;  ///< the line of its body in the file; 0: none
};

/// Compares blocks except for their lines in a file.
bool operator==(const Block& a, const Block& b);

/// A program for a servo robot: poses, loops, branches, arithmetic. It gets a duration when it is
/// run (`flow::run`), and angles when a servo map gives its words a meaning.
/// Source: spec roboviemaker-motion ("RobovieMaker2 course", no. 6).
struct PoseFlow {
  FlowFormat format = FlowFormat::V1R4;
  std::size_t num_sliders = 0;  ///< _ENABLE_AXIS: the number of words of every pose, for sliders 0
                                ///< and up
  std::vector<Block> blocks;    ///< in the file's order, which is not that of the flow
  bool operator==(const PoseFlow&) const = default;
};

/// The block where a flow begins: pose 0, or the first start block; `kNoBlock` if there is none.
int first_block(const PoseFlow& flow);

/// The targets of a block's arrows that can be followed: of the normal arrow, and for loops,
/// branches and WORD_N poses of the branch. `kNoBlock` is omitted.
std::vector<int> successors(const PoseFlow& flow, std::size_t number);

/// Whether each block is reachable from the first one; shape (blocks). All false without a first
/// block.
std::vector<bool> reachable_blocks(const PoseFlow& flow);

/// "start", "end", "pose", "loop", "arithmetic" or "branch".
std::string_view body_name(const Block& block);

/// A doubtful structure of a flow. A file with it can still be read.
enum class FlowFault {
  Unreachable,       ///< no path leads to the block
  DeadEnd,           ///< the normal arrow of a block other than an end block leads nowhere; not for
                     ///< WORD_N, where flows end this way
  NoBranch,          ///< the branch of a loop or branch block leads nowhere
  EndlessCycle,      ///< poses in an endless cycle; reported once, at its first block
  CycleWithoutPose,  ///< blocks in a cycle that can take no time
  NoEnd,             ///< V1R4: there is no end block; reported at block 0
};

struct FlowFinding {
  FlowFault fault = FlowFault::Unreachable;
  std::size_t block = 0;
};

/// Analyses all paths through a flow, without running it. Results are in the order of blocks.
/// Precondition: arrows lead to blocks or to `kNoBlock`.
std::vector<FlowFinding> find_flow_faults(const PoseFlow& flow);

}  // namespace kinefile

#pragma GCC visibility pop
