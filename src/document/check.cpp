// SPDX-License-Identifier: MIT
#include "kinefile/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinefile/marks.hpp"
#include "kinefile/place.hpp"

namespace kinefile {
namespace {

void tell(const std::vector<Mark>& marks, Diagnostics& diagnostics) {
  for (const Mark& mark : marks) diagnostics.add(mark.severity, mark.code, mark.message);
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

/// Puts a document that is not a motion (a body motion or a flow) on the robot.
void check_on_robot(const Document& document, const CheckOptions& options,
                    Diagnostics& diagnostics) {
  const auto placed = place(document, options.robot, options.lenient, diagnostics);
  if (placed) tell(find_limit_marks(placed->motion), diagnostics);
  if (!placed && !diagnostics.has_errors()) diagnostics.add(placed.error());
}

}  // namespace

void check(const Document& document, const CheckOptions& options, Diagnostics& diagnostics) {
  Diagnostics found;
  found.warnings_are_errors = diagnostics.warnings_are_errors;
  if (const Motion* motion = std::get_if<Motion>(&document.content)) {
    tell(find_marks(*motion), found);
  } else if (const BodyMotion* body = std::get_if<BodyMotion>(&document.content)) {
    check_components(*body, found);
  }
  if (options.robot && !has_skeleton(document)) {
    check_on_robot(document, options, found);
  }
  for (Diagnostic item : found.items()) {
    if (item.place.source.empty()) item.place.source = options.name;
    diagnostics.add(std::move(item));
  }
}

Result<void> check(const DocumentSource& source, const CheckOptions& options,
                   Diagnostics& diagnostics) {
  const auto document = source(diagnostics);
  if (document) {
    check(**document, options, diagnostics);
    return {};
  }
  // A fault of the file itself, and not of its content, is not in the diagnostics yet.
  if (!diagnostics.has_errors()) diagnostics.add(document.error());
  return fail(document.error());
}

}  // namespace kinefile
