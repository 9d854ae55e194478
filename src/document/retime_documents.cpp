// SPDX-License-Identifier: MIT
#include "kinefile/retime_documents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

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

/// Repeats the last values of the components that end before others do, so that all cover the same
/// frames.
/// \param periods  of the components before they were brought to this rate, in seconds
void hold_to_one_end(BodyMotion& body, std::span<const double> periods, double frame_rate,
                     Diagnostics& diagnostics) {
  std::size_t num_frames = 0;
  for (const Component& component : body.components) {
    if (component.kind != ComponentKind::Other) {
      num_frames = std::max(num_frames, component.num_frames);
    }
  }
  for (std::size_t c = 0; c < body.components.size(); ++c) {
    Component& component = body.components[c];
    const bool is_short = component.num_frames > 0 && component.num_frames < num_frames;
    if (component.kind == ComponentKind::Other || !is_short) continue;
    const double seconds = static_cast<double>(num_frames - component.num_frames) / frame_rate;
    // A frame stands for the time until the next one would come.
    constexpr double kRounding = 1e-6;
    const bool is_within_frame = seconds <= periods[c] * (1 + kRounding);
    diagnostics.add(is_within_frame ? Severity::Note : Severity::Warning, "RTM010",
                    fmt::format("'{}' ends {:.6g} s before the other components; its last values "
                                "are held",
                                component.content, seconds));
    const auto row = component.row(component.num_frames - 1);
    const std::vector<double> last(row.begin(), row.end());
    for (; component.num_frames < num_frames; ++component.num_frames) {
      component.values.append(last);
    }
  }
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
  if (body == nullptr) return change_motion(document, resampled);
  std::vector<double> periods;
  for (const Component& component : body->components) {
    periods.push_back(frame_time(component.timeline));
  }
  if (auto changed = change_components(*body, false, resampled); !changed) return changed;
  hold_to_one_end(*body, periods, frame_rate, diagnostics);
  return {};
}

}  // namespace kinefile::retime
