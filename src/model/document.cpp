// SPDX-License-Identifier: MIT
#include "kinefile/document.hpp"

#include <fmt/format.h>

#include <iterator>

namespace kinefile {

std::string_view kind_name(const Document& document) {
  constexpr std::string_view kNames[] = {"motion", "skeleton", "body_motion", "pose_flow"};
  static_assert(std::size(kNames) == std::variant_size_v<decltype(document.content)>);
  return kNames[document.content.index()];
}

namespace {

/// The kind of a document, for a sentence.
std::string_view words_for_kind(const Document& document) {
  constexpr std::string_view kWords[] = {"a motion", "a skeleton alone", "a body motion",
                                         "a flow of poses"};
  return kWords[document.content.index()];
}

}  // namespace

bool contains(const Kinds& kinds, const Document& document) {
  const bool is_in[] = {kinds.motions, kinds.skeletons, kinds.body_motions, kinds.flows};
  static_assert(std::size(is_in) == std::variant_size_v<decltype(document.content)>);
  return is_in[document.content.index()];
}

Error wrong_kind(const Document& document, std::string_view wanted) {
  return make_error(ErrorKind::Usage, "DOC001",
                    fmt::format("expected {}, found {}", wanted, words_for_kind(document)));
}

Result<void> validate(const Document& document) {
  if (const Motion* motion = std::get_if<Motion>(&document.content)) return validate(*motion);
  if (const Skeleton* skeleton = std::get_if<Skeleton>(&document.content)) {
    return validate(*skeleton);
  }
  const BodyMotion* body = std::get_if<BodyMotion>(&document.content);
  if (body == nullptr) return {};
  for (const Component& component : body->components) {
    const bool is_whole = component.kind == ComponentKind::Other ||
                          component.values.size() == component.num_frames * component.row_size();
    if (is_whole) continue;
    return fail(
        ErrorKind::InvalidInput, "MDL002",
        fmt::format("expected {} frames of {} values in the component '{}', found {} values",
                    component.num_frames, component.row_size(), component.content,
                    component.values.size()));
  }
  return {};
}

const Skeleton& skeleton_of(const Document& document) {
  static const Skeleton kNone;
  if (const Motion* motion = std::get_if<Motion>(&document.content)) return motion->skeleton;
  const Skeleton* skeleton = std::get_if<Skeleton>(&document.content);
  return skeleton != nullptr ? *skeleton : kNone;
}

Motion still_or_moving(const Document& document) {
  if (const Motion* motion = std::get_if<Motion>(&document.content)) return *motion;
  Motion still{skeleton_of(document), {}};
  still.clip.num_coordinates = still.skeleton.coordinates.size();
  return still;
}

bool has_skeleton(const Document& document) {
  return std::holds_alternative<Motion>(document.content) ||
         std::holds_alternative<Skeleton>(document.content);
}

}  // namespace kinefile
