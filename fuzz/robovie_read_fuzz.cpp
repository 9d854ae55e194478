// SPDX-License-Identifier: MIT
// Any bytes as a motion of RobovieMaker, held against a project of any bytes: no crash, no hang,
// and either a flow that can be written or an error with a place. What is written reads as the same
// flow, and is written the same again.

#include "checks.hpp"
#include "kinefile/robovie.hpp"

namespace {

using namespace kinefile;
using namespace kinefile::fuzz;

/// Every file of a project is the same bytes; none of them may matter to a flow but by warnings.
Resolver resolver_of(std::string_view bytes) {
  Resolver resolver;
  resolver.open = [bytes](const std::string& name) -> std::optional<CompanionFile> {
    return CompanionFile{name, bytes, nullptr};
  };
  return resolver;
}

std::shared_ptr<const RobotProject> project_of(std::string_view bytes, bool is_lenient) {
  // The names of the files stand before the bytes, so that they are opened.
  const std::string rpj =
      "SLDINI:[[a.ini]]\nROMINI:[[b.ini]]\nDEFPOSINI:[[c.ini]]\nMAPINI:[[d.ini]]\n";
  Diagnostics diagnostics;
  const auto project =
      read_project(rpj, {.lenient = is_lenient, .companions = resolver_of(bytes)}, diagnostics);
  require(project.has_value() == !diagnostics.has_errors());
  for (const Diagnostic& item : diagnostics.items()) require(item.place.line > 0);
  Diagnostics ignored;
  const auto alone = read_project(bytes, {.companions = resolver_of(bytes)}, ignored);
  require(alone.has_value() == !ignored.has_errors());
  if (!project) return nullptr;
  require(base_values(*project).size() <= project->sliders.size());
  for (const Slider& slider : project->sliders) {
    require(slider.minimum <= slider.maximum && slider.step > 0);
    require(slider.partner < static_cast<int>(project->sliders.size()));
  }
  return std::make_shared<const RobotProject>(*project);
}

void check_flow(const PoseFlow& flow) {
  require(flow.num_sliders > 0 && flow.num_sliders <= max_sliders(flow.format));
  const int count = static_cast<int>(flow.blocks.size());
  for (const Block& block : flow.blocks) {
    require(block.normal >= kNoBlock && block.normal < count);
    require(block.branch >= kNoBlock && block.branch < count);
    const PoseBlock* const pose = std::get_if<PoseBlock>(&block.body);
    if (pose == nullptr) continue;
    require(pose->words.size() == flow.num_sliders);
    require(pose->ticks >= 1 && pose->ticks <= kMaxTicks);
  }
  find_flow_faults(flow);
}

void check_round_trip(const Document& document, const std::string& encoding) {
  const WriteOptions to = {.of_formats = robovie::WriteOptions{encoding}};
  const std::string text = written(document, "robovie", to);
  Diagnostics diagnostics;
  const auto again = find_format("robovie")->read(text, {}, diagnostics);
  require(again.has_value());
  require(std::get<PoseFlow>(again->content) == std::get<PoseFlow>(document.content));
  require(written(*again, "robovie") == text);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  ReadOptions options;
  options.lenient = (data[0] & 1) != 0;
  options.project = project_of(bytes, options.lenient);
  if ((data[0] & 2) != 0) options.of_formats = robovie::ReadOptions{.max_speed = 10};
  Diagnostics diagnostics;
  const auto document = find_format("robovie")->read(bytes, options, diagnostics);
  check_reading(document, diagnostics);
  if (!document) return 0;
  check_flow(std::get<PoseFlow>(document->content));
  // What was no character has become U+FFFD, which not every encoding has.
  if (diagnostics.count_of("TXT001", Severity::Warning) == 0) check_round_trip(*document, "");
  check_round_trip(*document, "utf-16le");
  return 0;
}
