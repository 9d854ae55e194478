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

/// The size of a component of a body motion.
struct ComponentSize {
  std::size_t num_frames = 0;
  std::size_t num_parts = 0;
  double frame_rate = 0;  ///< frames per second; 0 if there is none
};

/// How two components of one kind and content differ.
struct ComponentDifference {
  ComponentKind kind = ComponentKind::Values;
  std::string content;
  std::optional<ComponentSize> first;   ///< absent if only the second body motion has it
  std::optional<ComponentSize> second;  ///< absent if only the first one has it
  bool has_one_size = true;  ///< equally many frames and parts in both; otherwise numbers are not
                             ///< compared
  bool has_same_times = true;
  LargestDifference distance = {};  ///< for poses and points in metres, for values in their own
                                    ///< unit
  LargestDifference rotation = {};  ///< for poses, in degrees
  bool is_different = false;        ///< in numbers, size, times or frame of reference
};

/// How two body motions differ, component by component: those of the first, then those that only
/// the second has. For components that are kept as text (`ComponentKind::Other`), only their
/// presence is compared.
struct BodyComparison {
  std::vector<ComponentDifference> components;
};

/// One difference between two flows.
struct FlowDifference {
  std::optional<std::size_t> block = std::nullopt;  ///< absent: in the flow as a whole
  std::string what;                                 ///< "ticks", "s3", "next", "name", ...
  std::string first, second;                        ///< as written in a file; empty: not present
};

/// How two flows differ, block by block in the order of their numbers. Positions of blocks in the
/// editor and lengths of arrows are not compared.
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
  double tolerance = 0;  ///< distances up to this do not count as differences; in the first
                         ///< document's unit of length
};

/// Compares two documents: motions (a skeleton alone is one in its rest pose) by the positions of
/// their joints (see `compare_motions`), body motions by their components, flows by their blocks.
/// \errors CLI001 (Usage) if they are not of one kind
Result<Comparison> compare(const Document& first, const Document& second,
                           const CompareOptions& options = {});

}  // namespace kinefile

#pragma GCC visibility pop
