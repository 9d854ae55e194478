// SPDX-License-Identifier: MIT
// Frames that have times of their own, for formats that cannot store such times.

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "kinefile/convert.hpp"
#include "kinefile/retime.hpp"

namespace kinefile {
namespace {

void tell_rate(const Format& format, const SteadyRate& rate, Diagnostics& diagnostics) {
  diagnostics.add(
      rate.holds_times ? Severity::Note : Severity::Warning, "CNV009",
      fmt::format(
          "{} has no place for times of single frames; they are interpolated to {} frames a "
          "second{}",
          format.name, rate.per_second,
          rate.holds_times ? "" : ", by their median step: no usual rate holds them all"));
}

/// The rate for components of which some have times of their own: that of the main component if it
/// has one, otherwise one rate for all times together.
Result<SteadyRate> rate_of_components(const BodyMotion& body) {
  const Component& main = *main_component(body);
  const FrameTimes* own = std::get_if<FrameTimes>(&main.timeline.given);
  if (own == nullptr || own->per_second) return retime::rate_for(main.timeline);
  std::vector<double> all;
  for (const Component& component : body.components) {
    if (auto rate = retime::rate_for(component.timeline); !rate) return rate;
    const Array<double>& times = own_times(component.timeline);
    all.insert(all.end(), times.begin(), times.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return retime::rate_for({FrameTimes{all}, 0});
}

/// The time of the earliest first frame.
double start_of(const BodyMotion& body) {
  double start = std::numeric_limits<double>::infinity();
  for (const Component& component : body.components) {
    if (component.kind == ComponentKind::Other || component.num_frames == 0) continue;
    start = std::min(start, time_of_frame(component.timeline, 0));
  }
  return start;
}

bool has_irregular(const BodyMotion& body) {
  const auto is_irregular = [](const Component& component) {
    return component.kind != ComponentKind::Other && component.num_frames > 0 &&
           has_own_times(component.timeline);
  };
  return main_component(body) != nullptr &&
         std::any_of(body.components.begin(), body.components.end(), is_irregular);
}

Result<void> steady_components(const Format& format, BodyMotion& body, bool lenient,
                               Diagnostics& diagnostics) {
  if (!has_irregular(body)) return {};
  const auto rate = rate_of_components(body);
  if (!rate) return fail(rate.error());
  retime::RetimeOptions options;
  options.lenient = lenient;
  const double start = start_of(body);
  for (Component& component : body.components) {
    if (component.kind == ComponentKind::Other || !has_own_times(component.timeline)) continue;
    const auto steady = retime::with_steady_rate(robot::motion_of_component(component),
                                                 rate->per_second, start, options, diagnostics);
    if (!steady) return fail(steady.error());
    component = robot::with_frames_of(component, *steady);
  }
  tell_rate(format, *rate, diagnostics);
  return {};
}

}  // namespace

Result<Document> at_steady_rate(const Format& format, Document document, bool lenient,
                                Diagnostics& diagnostics) {
  if (format.conventions.keeps_times) return document;
  if (BodyMotion* body = std::get_if<BodyMotion>(&document.content)) {
    const auto made = steady_components(format, *body, lenient, diagnostics);
    if (!made) return fail(made.error());
    return document;
  }
  Motion* motion = std::get_if<Motion>(&document.content);
  if (motion == nullptr || !has_own_times(motion->clip.timeline)) return document;
  const auto rate = retime::rate_for(motion->clip.timeline);
  if (!rate) return fail(rate.error());
  retime::RetimeOptions options;
  options.lenient = lenient;
  auto steady = retime::with_steady_rate(
      *motion, rate->per_second, time_of_frame(motion->clip.timeline, 0), options, diagnostics);
  if (!steady) return fail(std::move(steady.error()));
  *motion = std::move(*steady);
  tell_rate(format, *rate, diagnostics);
  return document;
}

}  // namespace kinefile
