// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "document/compare.hpp"
#include "kinefile/robot.hpp"

namespace kinefile {
namespace {

ComponentSize size_of(const Component& component) {
  const double rate = frame_rate(component.timeline);
  return {component.num_frames, component.num_parts, rate > 0 && std::isfinite(rate) ? rate : 0};
}

/// A component as a motion whose parts are named by number, because not every file names them.
Motion motion_by_numbers(Component component) {
  component.part_names.clear();
  return robot::motion_of_component(component);
}

ComponentDifference difference_of(const Component& a, const Component& b, double tolerance) {
  ComponentDifference difference;
  difference.kind = a.kind;
  difference.content = a.content;
  difference.first = size_of(a);
  difference.second = size_of(b);
  if (a.kind == ComponentKind::Other) return difference;
  difference.has_one_size = a.num_frames == b.num_frames && a.num_parts == b.num_parts;
  difference.has_same_times = have_same_times(a.timeline, b.timeline);
  difference.is_different = !difference.has_one_size;
  if (!difference.has_one_size) return difference;
  const MotionComparison comparison = compare_motions(motion_by_numbers(a), motion_by_numbers(b));
  difference.distance = comparison.distance;
  if (a.kind == ComponentKind::Poses) difference.rotation = comparison.rotation;
  difference.is_different = comparison.distance.value > tolerance || !difference.has_same_times ||
                            a.is_root_relative != b.is_root_relative;
  return difference;
}

/// A component that only one of two body motions has.
ComponentDifference alone(const Component& component) {
  ComponentDifference difference;
  difference.kind = component.kind;
  difference.content = component.content;
  difference.is_different = true;
  return difference;
}

}  // namespace

Comparison compare_components(const BodyMotion& first, const BodyMotion& second, double tolerance) {
  BodyComparison found;
  for (const Component& a : first.components) {
    const Component* b = find_component(second, a.kind, a.content);
    found.components.push_back(b != nullptr ? difference_of(a, *b, tolerance) : alone(a));
    if (b == nullptr) found.components.back().first = size_of(a);
  }
  for (const Component& b : second.components) {
    if (find_component(first, b.kind, b.content) != nullptr) continue;
    found.components.push_back(alone(b));
    found.components.back().second = size_of(b);
  }
  const bool is_different =
      first.components.size() != second.components.size() ||
      std::any_of(found.components.begin(), found.components.end(),
                  [](const ComponentDifference& difference) { return difference.is_different; });
  return {std::move(found), is_different};
}

}  // namespace kinefile
