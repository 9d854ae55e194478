// SPDX-License-Identifier: MIT
// Any bytes as a body motion, read with any options: no crash, no hang, and either components that
// hold what they say or an error with a place. What reads is written so that it reads the same, bit
// for bit, with all that is unknown, and is written the same again; as JSON, too.

#include <algorithm>

#include "checks.hpp"
#include "formats/choreonoid/bind.hpp"
#include "kinefile/choreonoid.hpp"

namespace {

using namespace kinefile;
using namespace kinefile::fuzz;

const choreonoid::KeptComponent& kept_of(const Component& component) {
  const auto* const kept = component.kept.get<choreonoid::KeptComponent>();
  require(kept != nullptr);
  return *kept;
}

const choreonoid::KeptFile& kept_of(const Document& document) {
  const auto* const kept = document.kept.get<choreonoid::KeptFile>();
  require(kept != nullptr);
  return *kept;
}

void require_same(const Component& a, const Component& b, bool is_json) {
  require(a.kind == b.kind);
  if (a.kind == ComponentKind::Other) {
    require(is_json || kept_of(a).text == kept_of(b).text);
    return;
  }
  require(a.content == b.content);
  require(a.num_parts == b.num_parts && a.num_frames == b.num_frames);
  require(a.pose_form == b.pose_form && a.is_root_relative == b.is_root_relative);
  require(same_values(a.values, b.values));
  require(same_values(own_times(a.timeline), own_times(b.timeline)));
  require(frame_rate(a.timeline) == frame_rate(b.timeline));
  // JSON has words of its own for what other YAML says.
  require(is_json || kept_of(a).unknown_keys == kept_of(b).unknown_keys);
}

void check_round_trip(const Document& document, const ReadOptions& options,
                      choreonoid::YamlStyle style) {
  const WriteOptions to = {.of_formats = choreonoid::WriteOptions{.style = style}};
  const std::string text = written(document, "choreonoid", to);
  Diagnostics diagnostics;
  const auto again = find_format("choreonoid")->read(text, options, diagnostics);
  require(again.has_value());
  // JSON's keys are words alone; others may become the same one.
  if (diagnostics.count_of("YML009", Severity::Warning) > 0) {
    require(style == choreonoid::YamlStyle::Json || kept_of(document).is_json);
    return;
  }
  const auto& first = std::get<BodyMotion>(document.content).components;
  const auto& second = std::get<BodyMotion>(again->content).components;
  require(first.size() == second.size());
  const bool is_json = style == choreonoid::YamlStyle::Json || kept_of(document).is_json;
  for (std::size_t i = 0; i < first.size(); ++i) require_same(first[i], second[i], is_json);
  require(is_json || kept_of(document).unknown_keys == kept_of(*again).unknown_keys);
  require(written(*again, "choreonoid", to) == text);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  ReadOptions options;
  options.lenient = (data[0] & 1) != 0;
  options.keeps_times = (data[0] & 2) != 0;
  options.timed_rounding = static_cast<TimedRounding>((data[0] >> 2) % 3);
  if ((data[0] & 16) != 0) options.fps = 25;
  Diagnostics diagnostics;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto document = find_format("choreonoid")->read(bytes, options, diagnostics);
  check_reading(document, diagnostics);
  if (!document) return 0;
  check_document(*document);
  check_round_trip(*document, options, choreonoid::YamlStyle::Kept);
  check_round_trip(*document, options, choreonoid::YamlStyle::Json);
  return 0;
}
