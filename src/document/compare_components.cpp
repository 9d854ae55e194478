// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "document/compare.hpp"
#include "kinefile/robot.hpp"

namespace kinefile {
namespace {

ComponentSize size_of(const Component& component) {
  const double rate = frame_rate(component.timeline);
  return {component.num_frames, component.num_parts, rate > 0 && std::isfinite(rate) ? rate : 0};
}

/// Parts that are compared at a time, so that motions of them stay small.
constexpr std::size_t kPartsAtOnce = 4096;

/// Some parts of a component as a motion. They are named by number, because not every file names
/// them.
Motion motion_of_parts(const Component& component, std::size_t first, std::size_t count) {
  Component unnamed;
  unnamed.kind = component.kind;
  unnamed.content = component.content;
  unnamed.is_root_relative = component.is_root_relative;
  Component parts = unnamed;
  parts.pose_form = component.pose_form;
  parts.num_parts = count;
  parts.num_frames = component.num_frames;
  parts.timeline = component.timeline;
  for (std::size_t i = 0; i < count; ++i) {
    parts.part_names.push_back(robot::name_of_part(unnamed, first + i));
  }
  const std::size_t width = component.width();
  parts.values.reserve(component.num_frames * count * width);
  for (std::size_t f = 0; f < component.num_frames; ++f) {
    parts.values.append(component.row(f).subspan(first * width, count * width));
  }
  return robot::motion_of_component(parts);
}

void keep_larger(const LargestDifference& other, LargestDifference& largest) {
  if (largest.joint.empty() || other.value > largest.value) largest = other;
}

/// Compares components of one size.
void compare_values(const Component& a, const Component& b, ComponentDifference& difference) {
  for (std::size_t first = 0; first < a.num_parts; first += kPartsAtOnce) {
    const std::size_t count = std::min(kPartsAtOnce, a.num_parts - first);
    const MotionComparison comparison =
        compare_motions(motion_of_parts(a, first, count), motion_of_parts(b, first, count));
    keep_larger(comparison.distance, difference.distance);
    if (a.kind == ComponentKind::Poses) keep_larger(comparison.rotation, difference.rotation);
  }
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
  compare_values(a, b, difference);
  difference.is_different = difference.distance.value > tolerance || !difference.has_same_times ||
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

std::pair<ComponentKind, std::string_view> key_of(const Component& component) {
  return {component.kind, component.content};
}

/// Components by what they hold; of equals the first, as `find_component` finds.
using ComponentIndex = std::map<std::pair<ComponentKind, std::string_view>, const Component*>;

ComponentIndex index_of(const BodyMotion& motion) {
  ComponentIndex index;
  for (const Component& one : motion.components) index.emplace(key_of(one), &one);
  return index;
}

}  // namespace

Comparison compare_components(const BodyMotion& first, const BodyMotion& second, double tolerance) {
  const ComponentIndex of_first = index_of(first);
  const ComponentIndex of_second = index_of(second);
  BodyComparison found;
  for (const Component& a : first.components) {
    const auto b = of_second.find(key_of(a));
    const bool is_alone = b == of_second.end();
    found.components.push_back(is_alone ? alone(a) : difference_of(a, *b->second, tolerance));
    if (is_alone) found.components.back().first = size_of(a);
  }
  for (const Component& b : second.components) {
    if (of_first.contains(key_of(b))) continue;
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
