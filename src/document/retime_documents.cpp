// SPDX-License-Identifier: MIT
#include "kinefile/retime_documents.hpp"

#include <utility>

#include "kinefile/operation.hpp"

namespace kinefile::retime {
namespace {

/// \errors DOC001 (Usage) if a document has no frames
Result<void> expect_frames(const Document& document) {
  if (has_frames(document)) return {};
  return fail(wrong_kind(document, "a motion to show at other times"));
}

/// The frames that a document's times refer to: those of a motion, or of a body motion's main
/// component. Precondition: `has_frames`.
std::pair<const Timeline*, std::size_t> main_frames(const Document& document) {
  if (const Motion* motion = std::get_if<Motion>(&document.content)) {
    return {&motion->clip.timeline, motion->clip.num_frames};
  }
  const Component& main = *main_component(*std::get_if<BodyMotion>(&document.content));
  return {&main.timeline, main.num_frames};
}

Result<std::vector<double>> weights_of(const Document& document, Diagnostics& diagnostics) {
  const Motion* motion = std::get_if<Motion>(&document.content);
  if (motion != nullptr) return contact_weights(*motion, diagnostics);
  return fail(ErrorKind::Usage, "CLI002",
              "expected a motion with a skeleton for --contacts, found components");
}

}  // namespace

bool has_frames(const Document& document) {
  const BodyMotion* body = std::get_if<BodyMotion>(&document.content);
  return std::holds_alternative<Motion>(document.content) ||
         (body != nullptr && main_component(*body) != nullptr);
}

Result<TimeMap> warp_map(const Document& document, const DocumentWarp& warp,
                         Diagnostics& diagnostics) {
  if (auto fit = expect_frames(document); !fit) return fail(std::move(fit.error()));
  const auto [timeline, num_frames] = main_frames(document);
  WarpOptions options = warp.options;
  if (warp.follows_contacts) {
    auto weights = weights_of(document, diagnostics);
    if (!weights) return fail(std::move(weights.error()));
    options.weights = std::move(*weights);
  }
  return warp_map(*timeline, num_frames, std::move(options), warp.keys_in_seconds, diagnostics);
}

Result<TimeMap> align_map(const Document& document, const Document& reference,
                          const AlignOptions& options, Diagnostics& diagnostics) {
  const Motion* motion = std::get_if<Motion>(&document.content);
  const Motion* other = std::get_if<Motion>(&reference.content);
  if (motion != nullptr && other != nullptr) {
    return align_map(*motion, *other, options, diagnostics);
  }
  return fail(wrong_kind(motion == nullptr ? document : reference, "a motion with a skeleton"));
}

Result<void> apply(Document& document, const TimeMap& map, const RetimeOptions& options,
                   Diagnostics& diagnostics) {
  if (auto fit = expect_frames(document); !fit) return fit;
  return change_motion(
      document, [&](const Motion& motion) { return apply(motion, map, options, diagnostics); });
}

Result<void> resample(Document& document, double frame_rate, const RetimeOptions& options,
                      Diagnostics& diagnostics) {
  if (auto fit = expect_frames(document); !fit) return fit;
  const auto resampled = [&](const Motion& motion) -> Result<Motion> {
    const auto map = resample_map(motion.clip, frame_rate);
    if (!map) return fail(map.error());
    return apply(motion, *map, options, diagnostics);
  };
  BodyMotion* body = std::get_if<BodyMotion>(&document.content);
  return body != nullptr ? change_components(*body, false, resampled)
                         : change_motion(document, resampled);
}

}  // namespace kinefile::retime
