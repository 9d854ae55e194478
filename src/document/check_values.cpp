// SPDX-License-Identifier: MIT
#include "document/check_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "kinefile/kinematics.hpp"
#include "kinefile/robot.hpp"

namespace kinefile {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;  // radians

double distance_of(const Vec3& a, const Vec3& b) { return (a - b).stableNorm(); }

/// Steps of something that moves that are longer than it can go.
struct Jumps {
  std::size_t first = 0;  ///< the frame before the first of them
  double distance = 0;    ///< of the first
  std::size_t count = 0;
};

/// Finds the jumps of something: steps longer than its size, at more than 30 sizes a second, and
/// far above its usual step if there are enough to know one.
/// \param place_of  its place in a frame
template <class PlaceOf>
Jumps find_jumps(const Timeline& timeline, std::size_t num_frames, double size,
                 const PlaceOf& place_of) {
  constexpr double kFastest = 30;  // sizes a second; at 15 frames a second two sizes a frame
  constexpr double kUsual = 20;    // usual steps
  constexpr std::size_t kFew = 8;  // steps
  std::vector<double> steps;
  Jumps jumps;
  for (std::size_t f = 0; f + 1 < num_frames; ++f) {
    const double step = distance_of(place_of(f), place_of(f + 1));
    if (!(step > size)) continue;
    const double seconds = time_of_frame(timeline, f + 1) - time_of_frame(timeline, f);
    if (!(step > kFastest * size * seconds)) continue;
    if (steps.empty()) {
      for (std::size_t i = 0; i + 1 < num_frames; ++i) {
        steps.push_back(distance_of(place_of(i), place_of(i + 1)));
      }
      std::erase_if(steps, [](double one) { return std::isnan(one); });
      const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
      std::nth_element(steps.begin(), middle, steps.end());
    }
    const bool is_known = steps.size() >= kFew;
    if (is_known && !(step > kUsual * steps[steps.size() / 2])) continue;
    if (jumps.count++ == 0) {
      jumps.first = f;
      jumps.distance = step;
    }
  }
  return jumps;
}

void tell_jumps(const Jumps& jumps, std::string_view what, std::string_view unit,
                Diagnostics& diagnostics) {
  if (jumps.count == 0) return;
  std::string message = fmt::format("{} jumps by {:.6g}{} from frame {} to {}", what,
                                    jumps.distance, unit, jumps.first, jumps.first + 1);
  if (jumps.count > 1) message += fmt::format(", the first of {} jumps", jumps.count);
  diagnostics.add(Severity::Note, "MOT006", std::move(message));
}

/// The degrees of freedom that move a joint's place by plain numbers.
std::vector<const DegreeOfFreedom*> translations_of(const Joint& joint) {
  std::vector<const DegreeOfFreedom*> found;
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind == DofKind::Translation || dof.kind == DofKind::Free) found.push_back(&dof);
  }
  return found;
}

Vec3 place_in_row(const std::vector<const DegreeOfFreedom*>& dofs, std::span<const double> row) {
  Vec3 place = Vec3::Zero();
  for (const DegreeOfFreedom* dof : dofs) {
    if (dof->kind == DofKind::Free) {
      place += Vec3(row[dof->coordinate], row[dof->coordinate + 1], row[dof->coordinate + 2]);
    } else {
      place += dof->axis * value_of(*dof, row[dof->coordinate]);
    }
  }
  return place;
}

void check_jumps(const Motion& motion, Diagnostics& diagnostics) {
  const double size = rest_size(motion.skeleton);
  if (!(size > 0)) return;
  for (const Joint& joint : motion.skeleton.joints) {
    const auto dofs = translations_of(joint);
    if (dofs.empty()) continue;
    const Jumps jumps =
        find_jumps(motion.clip.timeline, motion.clip.num_frames, size,
                   [&](std::size_t frame) { return place_in_row(dofs, motion.clip.row(frame)); });
    tell_jumps(jumps, fmt::format("joint '{}'", joint.name), "", diagnostics);
  }
}

/// The columns of the angles of a skeleton.
std::vector<std::size_t> angle_columns(const Skeleton& skeleton) {
  std::vector<std::size_t> columns;
  for (const Joint& joint : skeleton.joints) {
    for (const DegreeOfFreedom& dof : joint.dofs) {
      if (dof.kind == DofKind::Rotation) columns.push_back(dof.coordinate);
    }
  }
  return columns;
}

/// Notes a figure in degrees that moves, though none of its angles is above half a turn in radians.
void check_degrees(const Motion& motion, Diagnostics& diagnostics) {
  constexpr double kStill = 0.1, kMoving = 0.5;
  constexpr std::size_t kFew = 6;  // angles
  if (motion.skeleton.angle_unit != AngleUnit::Degrees) return;
  double largest = 0;
  std::size_t num_moving = 0;
  for (const std::size_t column : angle_columns(motion.skeleton)) {
    double largest_here = 0;
    for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
      const double angle = std::abs(motion.clip.row(f)[column]);
      if (!(angle <= std::numbers::pi)) return;
      largest_here = std::max(largest_here, angle);
    }
    num_moving += largest_here > kStill ? 1 : 0;
    largest = std::max(largest, largest_here);
  }
  if (num_moving < kFew || largest < kMoving) return;
  diagnostics.add(Severity::Note, "MOT009",
                  fmt::format("no angle is above {:.6g}, as if they were radians; they are read as "
                              "degrees",
                              largest));
}

/// Tells of the components that differ from the main one in length or rate. Others than joints may
/// have their own, as long as they last as long but for a frame.
void check_components(const BodyMotion& body, Diagnostics& diagnostics) {
  const Component* const main = main_component(body);
  for (const Component& component : body.components) {
    if (component.kind == ComponentKind::Other || robot::agree(component, *main)) continue;
    const double difference = std::abs(duration(component.timeline, component.num_frames) -
                                       duration(main->timeline, main->num_frames));
    const double frame = std::max(frame_time(component.timeline), frame_time(main->timeline));
    const bool is_fault = component.content == kJointDisplacement || !(difference <= frame) ||
                          have_same_times(component.timeline, main->timeline);
    diagnostics.add(is_fault ? Severity::Warning : Severity::Note, "BRG021",
                    fmt::format("the components differ in length or rate: {}; 'kinefile resample' "
                                "brings them to one",
                                robot::words_of_disagreement(component, *main)));
  }
}

/// A number of a component that is too large to be meant.
struct LargeValue {
  double value = 0;
  std::size_t frame = 0;
  std::size_t part = 0;
  std::size_t num_parts = 0;  ///< how many parts have one
};

/// The largest number of the parts beyond a limit, by size.
/// \param width  how many numbers of each part count
LargeValue find_large(const Component& component, std::size_t width, double limit) {
  LargeValue large;
  std::vector<bool> has_one(component.num_parts, false);
  for (std::size_t f = 0; f < component.num_frames; ++f) {
    const auto row = component.row(f);
    for (std::size_t part = 0; part < component.num_parts; ++part) {
      for (const double value : row.subspan(part * component.width(), width)) {
        if (!(std::abs(value) > limit) || !std::isfinite(value)) continue;
        has_one[part] = true;
        if (std::abs(value) > std::abs(large.value)) large = {value, f, part, 0};
      }
    }
  }
  large.num_parts = static_cast<std::size_t>(std::count(has_one.begin(), has_one.end(), true));
  return large;
}

std::string others(const LargeValue& large) {
  return large.num_parts > 1 ? fmt::format(", and {} more", large.num_parts - 1) : "";
}

void check_radians(const Component& component, Diagnostics& diagnostics) {
  const LargeValue large = find_large(component, 1, kTurn);
  if (large.num_parts == 0) return;
  diagnostics.add(
      Severity::Note, "MOT007",
      fmt::format("joint '{}' reaches {:.6g} (frame {}), beyond a full turn in radians, "
                  "as if in degrees{}",
                  robot::name_of_part(component, large.part), large.value, large.frame,
                  others(large)));
}

void check_places(const Component& component, Diagnostics& diagnostics) {
  constexpr double kFar = 100;  // m
  constexpr double kSize = 1;   // m, of a robot
  constexpr std::size_t kPlaceWidth = 3;
  const LargeValue large = find_large(component, kPlaceWidth, kFar);
  if (large.num_parts > 0) {
    diagnostics.add(
        Severity::Note, "MOT008",
        fmt::format("'{}' is {:.6g} m from the origin (frame {}), as if in millimetres{}",
                    robot::name_of_part(component, large.part), std::abs(large.value), large.frame,
                    others(large)));
  }
  for (std::size_t part = 0; part < component.num_parts; ++part) {
    const Jumps jumps =
        find_jumps(component.timeline, component.num_frames, kSize, [&](std::size_t frame) {
          const double* at = component.row(frame).data() + part * component.width();
          return Vec3(at[0], at[1], at[2]);
        });
    tell_jumps(jumps, fmt::format("'{}'", robot::name_of_part(component, part)), " m", diagnostics);
  }
}

}  // namespace

void check_values(const Motion& motion, Diagnostics& diagnostics) {
  check_jumps(motion, diagnostics);
  check_degrees(motion, diagnostics);
}

void check_values(const BodyMotion& body, bool has_robot, Diagnostics& diagnostics) {
  check_components(body, diagnostics);
  for (const Component& component : body.components) {
    const bool is_of_joints =
        component.kind == ComponentKind::Values && component.content == kJointDisplacement;
    if (is_of_joints && !has_robot) check_radians(component, diagnostics);
    const bool is_of_links =
        component.kind == ComponentKind::Poses && component.content == kLinkPosition;
    const bool is_of_zmp = component.kind == ComponentKind::Vectors && component.content == kZmp;
    if (is_of_links || is_of_zmp) check_places(component, diagnostics);
  }
}

}  // namespace kinefile
