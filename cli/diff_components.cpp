// SPDX-License-Identifier: MIT
#include "diff_components.hpp"

#include <fmt/format.h>

#include <cmath>

#include "report.hpp"

namespace kinefile::cli {
namespace {

bool have_one_shape(const Component& a, const Component& b) {
  return a.num_frames == b.num_frames && a.num_parts == b.num_parts;
}

/// A component as a motion, its parts by their numbers: not every file names them.
Motion motion_by_numbers(Component component) {
  component.part_names.clear();
  return robot::motion_of_component(component);
}

ComponentDifference difference_of(const Component& a, const Component* b, double tolerance) {
  ComponentDifference difference{a.content, &a, b, {}, {}, b == nullptr};
  if (b == nullptr || a.kind == ComponentKind::Other) return difference;
  difference.is_different = !have_one_shape(a, *b);
  if (difference.is_different) return difference;
  const MotionComparison comparison = compare_motions(motion_by_numbers(a), motion_by_numbers(*b));
  difference.distance = comparison.distance;
  if (a.kind == ComponentKind::Poses) difference.rotation = comparison.rotation;
  difference.is_different = comparison.distance.value > tolerance ||
                            !have_same_times(a.timeline, b->timeline) ||
                            a.is_root_relative != b->is_root_relative;
  return difference;
}

Json shape_of(const Component* component) {
  if (component == nullptr) return nullptr;
  const double rate = frame_rate(component->timeline);
  return {{"num_frames", component->num_frames},
          {"num_parts", component->num_parts},
          {"frame_rate", rate > 0 && std::isfinite(rate) ? Json(rate) : Json()}};
}

}  // namespace

void print_largest(std::string_view what, const LargestDifference& largest, std::string_view unit) {
  if (largest.joint.empty()) return;
  print_data(fmt::format("{:<22}{}{}", what, largest.value, unit));
  if (largest.value > 0) {
    print_data(fmt::format(" at '{}', frame {}, {} s", largest.joint, largest.frame, largest.time));
  }
  print_data("\n");
}

Json json_of(const LargestDifference& largest) {
  if (largest.joint.empty()) return nullptr;
  return {{"value", std::isfinite(largest.value) ? Json(largest.value) : Json("inf")},
          {"joint", largest.joint},
          {"frame", largest.frame},
          {"time", largest.time}};
}

BodyComparison compare_components(const BodyMotion& first, const BodyMotion& second,
                                  double tolerance) {
  BodyComparison comparison;
  for (const Component& a : first.components) {
    comparison.components.push_back(
        difference_of(a, find_component(second, a.kind, a.content), tolerance));
  }
  for (const Component& b : second.components) {
    if (find_component(first, b.kind, b.content) != nullptr) continue;
    comparison.components.push_back({b.content, nullptr, &b, {}, {}, true});
  }
  comparison.is_different = first.components.size() != second.components.size();
  for (const ComponentDifference& difference : comparison.components) {
    comparison.is_different |= difference.is_different;
  }
  return comparison;
}

void print_text(const BodyComparison& comparison) {
  for (const ComponentDifference& difference : comparison.components) {
    const Component* a = difference.first;
    const Component* b = difference.second;
    if (a == nullptr || b == nullptr) {
      print_data(fmt::format("{:<22}'{}'\n",
                             b == nullptr ? "only in the first" : "only in the second",
                             difference.content));
    } else if (a->kind != ComponentKind::Other && !have_one_shape(*a, *b)) {
      print_data(fmt::format("{:<22}{} frames of {} parts and {} of {}\n", a->content,
                             a->num_frames, a->num_parts, b->num_frames, b->num_parts));
    } else {
      print_largest(difference.content, difference.distance, "");
      print_largest("  rotation", difference.rotation, " degrees");
      const bool is_known = a->kind != ComponentKind::Other;
      if (is_known && !have_same_times(a->timeline, b->timeline))
        print_data("  the times differ\n");
    }
  }
  print_data(comparison.is_different ? "the motions differ\n" : "the motions agree\n");
}

Json json_of(const BodyComparison& comparison) {
  Json components = Json::array();
  for (const ComponentDifference& difference : comparison.components) {
    components.push_back({{"content", difference.content},
                          {"is_different", difference.is_different},
                          {"distance", json_of(difference.distance)},
                          {"rotation_degrees", json_of(difference.rotation)},
                          {"first", shape_of(difference.first)},
                          {"second", shape_of(difference.second)}});
  }
  return {{"is_different", comparison.is_different}, {"components", components}};
}

}  // namespace kinefile::cli
