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

/// Which of RobovieMaker's two formats a flow is written in; they differ in what a flow can say.
enum class FlowFormat {
  WordN,  ///< POSEDEF_WORD_N, RobovieMaker for VS-RC003: poses alone, each with next and break
  V1R4,   ///< POSEDEF_V1R4, RobovieMaker2: blocks of seven kinds
};

/// The longest time of a pose, in ticks.
inline constexpr int kMaxTicks = 239;
inline constexpr std::size_t kNumServos = 30;
/// How many variables a robot has; the first ones are the sliders.
inline constexpr std::size_t kNumVariables = 256;
/// No block: an arrow that leads nowhere.
inline constexpr int kNoBlock = -1;

/// How many sliders a flow has at most: 64 and 62.
constexpr std::size_t max_sliders(FlowFormat format) {
  return format == FlowFormat::V1R4 ? 62 : 64;
}

/// The word of the format's header: "POSEDEF_WORD_N" or "POSEDEF_V1R4".
constexpr std::string_view header_word(FlowFormat format) {
  return format == FlowFormat::V1R4 ? "POSEDEF_V1R4" : "POSEDEF_WORD_N";
}

/// What a pose says of one slider: its actual value, in the units of that slider.
struct SliderWord {
  std::int16_t value = 0;
  bool is_enabled =
      false;  ///< written 0x; 0X is a slider that was disabled when the file was saved
  bool operator==(const SliderWord&) const = default;
};

struct StartBlock {
  bool operator==(const StartBlock&) const = default;
};

struct EndBlock {
  bool operator==(const EndBlock&) const = default;
};

/// Brings the sliders to their values in some time.
struct PoseBlock {
  int ticks = 1;                      ///< 1 to `kMaxTicks`: the time to reach it
  std::vector<SliderWord> words;      ///< one a slider: `PoseFlow::num_sliders`
  std::string sound;                  ///< a path relative to the project; empty: none
  std::bitset<kNumServos> servo_off;  ///< by channel; 1 in the file: without power
  bool operator==(const PoseBlock&) const = default;
};

/// Goes the normal way as long as the motion's button is held, the branch once it is not.
struct LoopBlock {
  bool operator==(const LoopBlock&) const = default;
};

enum class Arithmetic { Assign, Add, Subtract, Multiply, Divide };

/// variable := variable operation operand.
struct ArithmeticBlock {
  int variable = 0;  ///< 0 to 255
  Arithmetic operation = Arithmetic::Assign;
  bool has_variable_operand = false;  ///< _VARVAR: `operand` is a variable's number
  int operand = 0;                    ///< else a constant, -32768 to 32767
  bool operator==(const ArithmeticBlock&) const = default;
};

enum class Condition { Undefined, AtLeast, AtMost, BitsMatch, Equal, NotEqual, Always, Never };

/// Goes one of two ways.
struct BranchBlock {
  int variable = 0;  ///< 0 to 255
  Condition condition = Condition::Undefined;
  int detail =
      0;  ///< a threshold; of `BitsMatch` the wanted bits above, their mask in the low byte
  bool operator==(const BranchBlock&) const = default;
};

using BlockBody =
    std::variant<StartBlock, EndBlock, PoseBlock, LoopBlock, ArithmeticBlock, BranchBlock>;

/// A block of a flow. Its number is its place in `PoseFlow::blocks`.
struct Block {
  std::string name;       ///< V1R4 alone, as are the next four
  int x = 0, y = 0;       ///< where the editor draws it
  int normal_turn = 6;    ///< how far its normal arrow goes before it turns
  int branch_turn = 6;    ///< and its branch
  int normal = kNoBlock;  ///< the block that follows; of WORD_N "next"
  int branch = kNoBlock;  ///< the other one, of loops and branches; of WORD_N "break" of a pose
  BlockBody body;
  std::size_t line = 0;  ///< where its body stands in the file; 0: nowhere
};

/// The same blocks, wherever they stood in a file.
bool operator==(const Block& a, const Block& b);

/// A program for a servo robot: poses, loops, branches, arithmetic. It has no duration until it is
/// run (`flow::run`), and no angles until a servo map says what its words mean.
/// Source: spec roboviemaker-motion ("RobovieMaker2 course", no. 6).
struct PoseFlow {
  FlowFormat format = FlowFormat::V1R4;
  std::size_t num_sliders = 0;  ///< _ENABLE_AXIS: words of every pose, of sliders 0 up
  std::vector<Block> blocks;    ///< in the file's order, which is not that of the flow
  bool operator==(const PoseFlow&) const = default;
};

/// The block where a flow begins: pose 0, or the first start block; `kNoBlock` if there is none.
int first_block(const PoseFlow& flow);

/// The blocks that an arrow of this one leads to, as far as it can be taken: the normal one, and of
/// loops, branches and WORD_N poses the other. -1 is left out.
std::vector<int> successors(const PoseFlow& flow, std::size_t block);

/// Whether a way leads to a block from the first one; shape (blocks). None does without a first
/// one.
std::vector<bool> reachable_blocks(const PoseFlow& flow);

/// "start", "end", "pose", "loop", "arithmetic" or "branch".
std::string_view body_name(const Block& block);

/// What is odd about the way that a flow takes. None of it keeps a file from being read.
enum class FlowFault {
  Unreachable,   ///< no way leads to the block
  DeadEnd,       ///< the normal arrow of a block that is no end leads nowhere; of WORD_N that is
                 ///< how flows end
  NoBranch,      ///< the branch of a loop or branch block leads nowhere
  EndlessCycle,  ///< poses that go round for ever; told once, of its first block
  CycleWithoutPose,  ///< blocks that can go round and take no time at all
  NoEnd,             ///< V1R4: there is no end block; of block 0
};

struct FlowFinding {
  FlowFault fault = FlowFault::Unreachable;
  std::size_t block = 0;
};

/// Looks at all ways through a flow, without running it. In the order of blocks.
/// Precondition: arrows lead to blocks or to `kNoBlock`.
std::vector<FlowFinding> find_flow_faults(const PoseFlow& flow);

}  // namespace kinefile

#pragma GCC visibility pop
