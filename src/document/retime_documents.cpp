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

/// The frames in which a document's times are said: a motion's, or those of a body motion's main
/// component. Precondition: `has_frames`.
std::pair<const Timeline*, std::size_t> main_frames(const Document& document) {
  if (const Motion* motion = std::get_if<Motion>(&document.content)) {
    return {&motion->clip.timeline, motion->clip.num_frames};
  }
  const Component& main = *main_component(*std::get_if<BodyMotion>(&document.content));
  return {&main.timeline, main.num_frames};
}

/// A new frame happens when the old one of its number did.
Timeline with_times_of(const Timeline& old, std::size_t num_frames) {
  FrameTimes times;
  times.per_second = frame_rate(old);
  for (std::size_t f = 0; f < num_frames; ++f) times.seconds.push_back(time_of_frame(old, f));
  return Timeline{std::move(times), old.first_frame_number};
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
  for (WarpKey& key : options.keys) {
    if (!warp.keys_in_seconds) break;
    key = {frame_at_time(*timeline, key.old_frame), frame_at_time(*timeline, key.new_frame)};
  }
  if (warp.follows_contacts) {
    auto weights = weights_of(document, diagnostics);
    if (!weights) return fail(std::move(weights.error()));
    options.weights = std::move(*weights);
  }
  auto map = warp_map(num_frames, options);
  if (map && has_own_times(*timeline)) {
    map->timeline = with_times_of(*timeline, map->old_frames.size());
  }
  return map;
}

Result<TimeMap> align_map(const Document& document, const Document& reference,
                          const AlignOptions& options) {
  const Motion* motion = std::get_if<Motion>(&document.content);
  const Motion* other = std::get_if<Motion>(&reference.content);
  if (motion != nullptr && other != nullptr) return align_map(*motion, *other, options);
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
