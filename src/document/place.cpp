// SPDX-License-Identifier: MIT
#include "kinefile/place.hpp"

#include "document/sources.hpp"

namespace kinefile {
namespace {

Result<Placed> place_body(const BodyMotion& body, const DocumentSource& robot, bool lenient,
                          Diagnostics& diagnostics) {
  const auto model = model_of(robot, diagnostics);
  if (!model) return fail(model.error());
  Placed placed;
  auto motion = *model == nullptr ? robot::motion_of_links(body)
                                  : robot::pose(body, skeleton_of(**model), lenient, diagnostics);
  if (!motion) return fail(std::move(motion.error()));
  placed.motion = std::move(*motion);
  if (*model != nullptr) placed.recorded = body;
  return placed;
}

}  // namespace

Result<Placed> place(const Document& document, const DocumentSource& robot, bool lenient,
                     Diagnostics& diagnostics) {
  if (const BodyMotion* body = std::get_if<BodyMotion>(&document.content)) {
    return place_body(*body, robot, lenient, diagnostics);
  }
  if (!has_skeleton(document)) {
    return fail(ErrorKind::Usage, "CLI001",
                "expected a motion, found a flow of poses; 'kinefile run' with a servo map makes a "
                "motion of it");
  }
  return Placed{still_or_moving(document), std::holds_alternative<Skeleton>(document.content)};
}

}  // namespace kinefile
