// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "json_output.hpp"
#include "kinefile/kinefile.hpp"

namespace kinefile::cli {

/// A line about a largest difference; nothing if there was nothing to compare.
void print_largest(std::string_view what, const LargestDifference& largest, std::string_view unit);
/// The same as JSON: null if there was nothing to compare.
Json json_of(const LargestDifference& largest);

/// How two components of one content differ.
struct ComponentDifference {
  std::string content;
  const Component* first = nullptr;   ///< null if only the second file has it
  const Component* second = nullptr;  ///< null if only the first one has it
  LargestDifference distance;         ///< of poses and points a distance, of values a number
  LargestDifference rotation;         ///< of poses, degrees
  bool is_different = false;          ///< in numbers, length, parts, rate or frame of reference
};

struct BodyComparison {
  std::vector<ComponentDifference> components;
  bool is_different = false;
};

/// Compares components of the same kind and content, which outlive the result. What is kept as text
/// is only looked for.
BodyComparison compare_components(const BodyMotion& first, const BodyMotion& second,
                                  double tolerance);

void print_text(const BodyComparison& comparison);
Json json_of(const BodyComparison& comparison);

}  // namespace kinefile::cli
