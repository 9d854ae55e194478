// SPDX-License-Identifier: MIT
#include "kinefile/check.hpp"

#include "document/check_names.hpp"
#include "document/check_values.hpp"
#include "kinefile/marks.hpp"
#include "kinefile/place.hpp"

namespace kinefile {
namespace {

void tell(const std::vector<Mark>& marks, Diagnostics& diagnostics) {
  for (const Mark& mark : marks) diagnostics.add(mark.severity, mark.code, mark.message);
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
    check_values(*motion, found);
  } else if (const BodyMotion* body = std::get_if<BodyMotion>(&document.content)) {
    check_values(*body, static_cast<bool>(options.robot), found);
  }
  check_names(document, found);
  if (options.robot && !has_skeleton(document)) {
    check_on_robot(document, options, found);
  }
  diagnostics.append(named(found, options.name, diagnostics.warnings_are_errors));
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
