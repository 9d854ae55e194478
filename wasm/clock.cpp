// SPDX-License-Identifier: MIT
#include "clock.hpp"

#include <span>
#include <utility>

namespace kinefile::page {
namespace {

struct Frames {
  std::size_t count = 0;
  Timeline timeline = {};
};

/// The frames of a document; none for one that has no times.
Frames frames_of(const Document& document) {
  if (const Motion* motion = std::get_if<Motion>(&document.content)) {
    return {motion->clip.num_frames, motion->clip.timeline};
  }
  const BodyMotion* body = std::get_if<BodyMotion>(&document.content);
  const Component* main = body == nullptr ? nullptr : main_component(*body);
  if (main == nullptr) return {};
  return {main->num_frames, main->timeline};
}

}  // namespace

std::optional<Document> clock_of(const Document& document) {
  const auto [count, timeline] = frames_of(document);
  if (count == 0) return std::nullopt;
  Component time;
  time.content = "Time";
  time.num_frames = count;
  time.timeline = timeline;
  time.values = Array<double>(count);
  const std::span<double> values = time.values.mutate();
  for (std::size_t f = 0; f < count; ++f) {
    values[f] = time_of_frame(timeline, f) - time_of_frame(timeline, 0);
  }
  BodyMotion body;
  body.components.push_back(std::move(time));
  Document clock;
  clock.content = std::move(body);
  return clock;
}

void turn_clock(std::optional<Document>& clock, const Document& document,
                const std::function<bool(Document& clock)>& change) {
  if (!clock) return;
  Document changed = *clock;
  if (change(changed)) clock = std::move(changed);
  if (frames_of(*clock).count != frames_of(document).count) clock.reset();
}

double start_of(const std::optional<Document>& clock) {
  if (!clock) return 0;
  const Component& time = std::get<BodyMotion>(clock->content).components.front();
  const double first = time.values[0], last = time.values[time.num_frames - 1];
  return first <= last ? first : 0;
}

}  // namespace kinefile::page
