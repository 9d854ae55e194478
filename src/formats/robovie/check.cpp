// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "formats/robovie/codes.hpp"
#include "formats/robovie/reader.hpp"

namespace kinefile::robovie {
namespace {

bool may_branch(const Block& block) {
  return std::holds_alternative<LoopBlock>(block.body) ||
         std::holds_alternative<BranchBlock>(block.body);
}

/// Whether an arrow leads to a block or is -1; reports others.
bool check_arrow(const Reader& reader, int arrow, std::size_t num_blocks, std::string_view name,
                 const char* at) {
  if (at == nullptr || (arrow >= kNoBlock && arrow < static_cast<int>(num_blocks))) return true;
  reader.error(code::kNoSuchBlock,
               fmt::format("expected the number of a block, 0 to {}, or -1 ({}), found {}",
                           num_blocks - 1, name, arrow),
               at);
  return false;
}

/// Reports arrows from a block to itself, and a branch that it cannot have.
void check_ways(const Reader& reader, const PoseFlow& flow, std::size_t number,
                const BlockPlaces& places) {
  const Block& block = flow.blocks[number];
  const bool is_word_n = flow.format == FlowFormat::WordN;
  const auto check_self = [&](int arrow, std::string_view name, const char* at) {
    if (arrow != static_cast<int>(number)) return;
    const std::string message = fmt::format("expected another {0} ({1}), found {0} {2} itself",
                                            is_word_n ? "pose" : "block", name, number);
    if (is_word_n) return reader.error(code::kPoseToItself, message, at);
    reader.warn(code::kBlockToItself, message, at);
  };
  check_self(block.normal, is_word_n ? "next" : "normal", places.normal);
  if (is_word_n || may_branch(block)) {
    check_self(block.branch, is_word_n ? "break" : "branch", places.branch);
  } else if (block.branch != kNoBlock) {
    reader.error(code::kNeedlessBranch,
                 fmt::format("expected -1 for the branch of a block of kind {}, found {}",
                             body_name(block), block.branch),
                 places.branch);
  }
}

void check_arrows(const Reader& reader, FlowFile& file) {
  const PoseFlow& flow = file.flow;
  const bool is_word_n = flow.format == FlowFormat::WordN;
  const std::size_t count = flow.blocks.size();
  for (std::size_t b = 0; b < count; ++b) {
    const BlockPlaces& places = file.places[b];
    const Block& block = flow.blocks[b];
    if (places.normal == nullptr) continue;  // the line with its arrows could not be read
    const bool is_normal =
        check_arrow(reader, block.normal, count, is_word_n ? "next" : "normal", places.normal);
    const bool is_branch =
        check_arrow(reader, block.branch, count, is_word_n ? "break" : "branch", places.branch);
    if (!is_normal || !is_branch) file.is_whole = false;
    if (places.body != nullptr) check_ways(reader, flow, b, places);
  }
}

void check_starts(const Reader& reader, const FlowFile& file) {
  std::size_t num_starts = 0;
  for (std::size_t b = 0; b < file.flow.blocks.size(); ++b) {
    if (!std::holds_alternative<StartBlock>(file.flow.blocks[b].body)) continue;
    if (++num_starts == 1) continue;
    reader.error(code::kNotOneStart, "expected one start block, found another one",
                 file.places[b].body);
  }
  if (num_starts == 0) {
    reader.error(code::kNotOneStart, "expected one start block (_STARTMOT:), found none",
                 file.start);
  }
}

void tell_fault(const Reader& reader, const FlowFile& file, const FlowFinding& finding) {
  const BlockPlaces& places = file.places[finding.block];
  const std::size_t number = finding.block;
  const std::string_view kind = file.flow.format == FlowFormat::WordN ? "pose" : "block";
  switch (finding.fault) {
    case FlowFault::Unreachable:
      return reader.warn(code::kUnreachable, fmt::format("no way leads to {} {}", kind, number),
                         places.body);
    case FlowFault::DeadEnd:
      return reader.warn(
          code::kDeadEnd,
          fmt::format("the normal arrow of block {} leads nowhere, and it is no end", number),
          places.normal);
    case FlowFault::NoBranch:
      return reader.warn(code::kNoBranch,
                         fmt::format("the branch of block {} leads nowhere", number),
                         places.branch);
    case FlowFault::EndlessCycle:
      return reader.warn(
          code::kEndlessCycle,
          fmt::format("{} {} is part of a circle that nothing leads out of", kind, number),
          places.body);
    case FlowFault::CycleWithoutPose:
      return reader.warn(code::kCycleWithoutPose,
                         fmt::format("block {} is part of a circle without a pose, which takes no "
                                     "time",
                                     number),
                         places.body);
    case FlowFault::NoEnd:
      return reader.warn(code::kNoEnd, "there is no end block (_ENDMOT:)", file.start);
  }
}

/// Whether a motion should not write a variable: sliders and variables that the robot writes.
bool is_read_only(int variable) {
  return variable <= 63 || (variable >= 128 && variable <= 155) ||
         (variable >= 222 && variable <= 239);
}

void check_arithmetic(const Reader& reader, const ArithmeticBlock& block,
                      const BlockPlaces& places) {
  if (is_read_only(block.variable)) {
    reader.warn(code::kReadOnly,
                fmt::format("variable {} is the robot's own, to be read; 64 to 127 are free",
                            block.variable),
                places.settings[0]);
  }
  const bool divides = block.operation == Arithmetic::Divide && !block.has_variable_operand;
  if (divides && block.operand == 0) {
    reader.error(code::kDivisionByZero, "expected a divisor other than 0", places.settings[2]);
  }
}

void check_branch(const Reader& reader, const BranchBlock& block, const BlockPlaces& places) {
  const bool is_undefined = block.condition == Condition::Undefined;
  if (is_undefined) {
    reader.warn(code::kUndefined, "the condition is undefined (0)", places.settings[1]);
  }
  if (block.condition == Condition::BitsMatch && (block.detail & 0xFF) == 0) {
    reader.warn(code::kNoBits, "the condition looks at no bit: the low byte of its detail is 0",
                places.settings[2]);
  }
  const bool has_detail =
      !is_undefined && block.condition != Condition::Always && block.condition != Condition::Never;
  if (!has_detail && block.detail != 0) {
    reader.warn(
        code::kNeedlessDetail,
        fmt::format("expected the detail 0 for a condition that has none, found {}", block.detail),
        places.settings[2]);
  }
}

bool is_absolute(std::string_view path) {
  return path.starts_with('\\') || path.starts_with('/') || path.find(':') == 1;
}

void check_pose(const Reader& reader, const PoseBlock& pose, FlowFormat format,
                const BlockPlaces& places) {
  const char* const sound = places.settings[format == FlowFormat::WordN ? 4 : 2];
  if (is_absolute(pose.sound) || pose.sound.find('/') != std::string::npos) {
    reader.warn(code::kSoundPath,
                fmt::format("expected a sound's path relative to the project, with '\\', found {}",
                            text::quoted(pose.sound)),
                sound);
  }
  const std::size_t first_lost = max_sliders(FlowFormat::V1R4);
  for (std::size_t slider = first_lost; slider < pose.words.size(); ++slider) {
    if (!pose.words[slider].is_enabled) continue;
    reader.warn(code::kLastSliders,
                fmt::format("slider {} is in use, which RobovieMaker2 does not have", slider),
                place_of_word(places.settings[1], slider));
  }
}

void check_bodies(const Reader& reader, const FlowFile& file) {
  for (std::size_t b = 0; b < file.flow.blocks.size(); ++b) {
    const BlockPlaces& places = file.places[b];
    if (places.body == nullptr || places.settings[0] == nullptr) continue;
    const BlockBody& body = file.flow.blocks[b].body;
    if (const auto* pose = std::get_if<PoseBlock>(&body)) {
      check_pose(reader, *pose, file.flow.format, places);
    } else if (const auto* arithmetic = std::get_if<ArithmeticBlock>(&body)) {
      check_arithmetic(reader, *arithmetic, places);
    } else if (const auto* branch = std::get_if<BranchBlock>(&body)) {
      check_branch(reader, *branch, places);
    }
  }
}

}  // namespace

void check(const Reader& reader, FlowFile& file) {
  if (file.start == nullptr) return;  // nothing was read
  check_arrows(reader, file);
  check_bodies(reader, file);
  if (file.flow.format == FlowFormat::V1R4) {
    check_starts(reader, file);
  } else if (file.flow.blocks.empty()) {
    reader.error(code::kNoPose, "expected a pose (_POSE:), found none", file.start);
  }
  if (!file.is_whole) return;  // arrows that were not read are not missing
  for (const FlowFinding& finding : find_flow_faults(file.flow)) {
    tell_fault(reader, file, finding);
  }
}

}  // namespace kinefile::robovie
