// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "kinefile/compare.hpp"
#include "kinefile/document.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// How large a component of a body motion is.
struct ComponentSize {
  std::size_t num_frames = 0;
  std::size_t num_parts = 0;
  double frame_rate = 0;  ///< frames a second; 0 where there is none
};

/// How two components of one kind and content differ.
struct ComponentDifference {
  ComponentKind kind = ComponentKind::Values;
  std::string content;
  std::optional<ComponentSize> first;   ///< absent if only the second body motion has it
  std::optional<ComponentSize> second;  ///< absent if only the first one has it
  bool has_one_size = true;  ///< as many frames and parts in both; else numbers are not compared
  bool has_same_times = true;
  LargestDifference distance = {};  ///< of poses and points in metres, of values a number
  LargestDifference rotation = {};  ///< of poses, in degrees
  bool is_different = false;        ///< in numbers, size, times or frame of reference
};

/// How two body motions differ, component by component: those of the first, then those that only
/// the second has. What is kept as text (`ComponentKind::Other`) is only looked for.
struct BodyComparison {
  std::vector<ComponentDifference> components;
};

/// One thing in which two flows differ.
struct FlowDifference {
  std::optional<std::size_t> block = std::nullopt;  ///< absent: of the flow as a whole
  std::string what;                                 ///< "ticks", "s3", "next", "name", ...
  std::string first, second;                        ///< as a file has it; empty: it is not there
};

/// How two flows differ, block by block in the order of their numbers. Where the editor draws
/// blocks and how long arrows are is no difference.
struct FlowComparison {
  std::vector<FlowDifference> differences;
};

/// How two documents of one kind differ.
struct Comparison {
  std::variant<MotionComparison, BodyComparison, FlowComparison> found;
  bool is_different = false;
};

/// What counts as a difference.
struct CompareOptions {
  double tolerance = 0;  ///< distances up to this are none, in the first document's unit of length
};

/// Compares two documents: motions (a skeleton alone is one in its rest pose) by where they put
/// their joints (see `compare_motions`), body motions by their components, flows by their blocks.
/// \errors CLI001 (Usage) if they are not of one kind
Result<Comparison> compare(const Document& first, const Document& second,
                           const CompareOptions& options = {});

}  // namespace kinefile

#pragma GCC visibility pop
