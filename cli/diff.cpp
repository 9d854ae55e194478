// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "command.hpp"
#include "json_output.hpp"
#include "options.hpp"
#include "report.hpp"

namespace kinefile::cli {
namespace {

struct Diff {
  std::string first;
  std::string second;
  double tolerance = 0;
  bool is_json = false;
  Reading reading;
};

/// Prints a line about a largest difference; no line if nothing was compared.
void print_largest(std::string_view what, const LargestDifference& largest, std::string_view unit) {
  if (largest.joint.empty()) return;
  print_lines(fmt::format("{:<22}{}{}", what, largest.value, unit));
  if (largest.value > 0) {
    print_lines(
        fmt::format(" at '{}', frame {}, {} s", largest.joint, largest.frame, largest.time));
  }
  print_lines("\n");
}

/// The same as JSON: null if nothing was compared.
Json json_of(const LargestDifference& largest) {
  if (largest.joint.empty()) return nullptr;
  return {{"value", std::isfinite(largest.value) ? Json(largest.value) : Json("inf")},
          {"joint", largest.joint},
          {"frame", largest.frame},
          {"time", largest.time}};
}

void print_names(std::string_view what, const std::vector<std::string>& names) {
  for (const std::string& name : names) print_lines(fmt::format("{:<22}'{}'\n", what, name));
}

void print_text(const MotionComparison& comparison, bool is_different) {
  print_largest("largest distance", comparison.distance, "");
  print_largest("largest tip distance", comparison.tip_distance, "");
  print_largest("largest rotation", comparison.rotation, " degrees");
  print_names("only in the first", comparison.only_in_first);
  print_names("only in the second", comparison.only_in_second);
  print_names("tips not compared", comparison.other_tips);
  if (comparison.num_frames_first != comparison.num_frames_second) {
    print_lines(fmt::format("{:<22}{} and {}\n", "frames", comparison.num_frames_first,
                            comparison.num_frames_second));
  }
  print_lines(is_different ? "the motions differ\n" : "the motions agree\n");
}

Json json_of(const MotionComparison& comparison, bool is_different) {
  return {{"is_different", is_different},
          {"distance", json_of(comparison.distance)},
          {"tip_distance", json_of(comparison.tip_distance)},
          {"rotation_degrees", json_of(comparison.rotation)},
          {"only_in_first", comparison.only_in_first},
          {"only_in_second", comparison.only_in_second},
          {"tips_not_compared", comparison.other_tips},
          {"num_frames", {comparison.num_frames_first, comparison.num_frames_second}}};
}

void print_component(const ComponentDifference& difference) {
  const auto& first = difference.first;
  const auto& second = difference.second;
  if (!first || !second) {
    print_lines(fmt::format("{:<22}'{}'\n", first ? "only in the first" : "only in the second",
                            difference.content));
  } else if (!difference.has_one_size) {
    print_lines(fmt::format("{:<22}{} frames of {} parts and {} of {}\n", difference.content,
                            first->num_frames, first->num_parts, second->num_frames,
                            second->num_parts));
  } else {
    print_largest(difference.content, difference.distance, "");
    print_largest("  rotation", difference.rotation, " degrees");
    if (!difference.has_same_times) print_lines("  the times differ\n");
  }
}

void print_text(const BodyComparison& comparison, bool is_different) {
  for (const ComponentDifference& difference : comparison.components) print_component(difference);
  print_lines(is_different ? "the motions differ\n" : "the motions agree\n");
}

Json size_json(const std::optional<ComponentSize>& size) {
  if (!size) return nullptr;
  return {{"num_frames", size->num_frames},
          {"num_parts", size->num_parts},
          {"frame_rate", size->frame_rate > 0 ? Json(size->frame_rate) : Json()}};
}

Json json_of(const BodyComparison& comparison, bool is_different) {
  Json components = Json::array();
  for (const ComponentDifference& difference : comparison.components) {
    components.push_back({{"content", difference.content},
                          {"is_different", difference.is_different},
                          {"distance", json_of(difference.distance)},
                          {"rotation_degrees", json_of(difference.rotation)},
                          {"first", size_json(difference.first)},
                          {"second", size_json(difference.second)}});
  }
  return {{"is_different", is_different}, {"components", components}};
}

void print_text(const FlowComparison& comparison, bool is_different) {
  const auto shown = [](const std::string& value) { return value.empty() ? "nothing" : value; };
  for (const FlowDifference& difference : comparison.differences) {
    const std::string where =
        difference.block ? fmt::format("block {}", *difference.block) : std::string("flow");
    print_lines(fmt::format("{:<12}{:<10}{} and {}\n", where, difference.what,
                            shown(difference.first), shown(difference.second)));
  }
  print_lines(is_different ? "the flows differ\n" : "the flows agree\n");
}

Json json_of(const FlowComparison& comparison, bool is_different) {
  Json list = Json::array();
  for (const FlowDifference& difference : comparison.differences) {
    list.push_back({{"block", difference.block ? Json(*difference.block) : Json()},
                    {"what", difference.what},
                    {"first", difference.first},
                    {"second", difference.second}});
  }
  return {{"is_different", is_different}, {"differences", list}};
}

int run(const Diff& diff, const Globals& globals) {
  int exit_code = kDone;
  const auto first = load(diff.first, diff.reading, globals, exit_code);
  const auto second = load(diff.second, diff.reading, globals, exit_code);
  if (!first || !second) return exit_code;
  exit_code = finish_reading(diff.reading, globals, exit_code);
  if (exit_code != kDone) return exit_code;
  const auto comparison = compare(*first, *second, {diff.tolerance});
  if (!comparison) {
    print_error(comparison.error(), globals);
    return exit_code_of(comparison.error());
  }
  const bool is_different = comparison->is_different;
  std::visit(
      [&](const auto& found) {
        if (diff.is_json) {
          print_json(json_of(found, is_different));
        } else {
          print_text(found, is_different);
        }
      },
      comparison->found);
  return is_different ? kInvalid : kDone;
}

std::string check_tolerance(const std::string& text) {
  double tolerance = 0;
  const bool is_number = CLI::detail::lexical_cast(text, tolerance);
  return is_number && tolerance >= 0 && std::isfinite(tolerance) ? ""
                                                                 : "expected a distance from 0 up";
}

}  // namespace

void add_diff(CLI::App& app, Globals& globals) {
  auto diff = std::make_shared<Diff>();
  CLI::App* command = app.add_subcommand(
      "diff", "Compare where two motions put their joints, or what two flows say");
  command->add_option("A", diff->first, "The first file")->required();
  command->add_option("B", diff->second, "The second file")->required();
  command->add_option("--tolerance", diff->tolerance, "Distances up to this are no difference")
      ->check(check_tolerance)
      ->default_str("0")
      ->type_name("T");
  command->add_flag("--json", diff->is_json, "Print an object");
  add_reading_options(*command, diff->reading);
  command->callback(
      [diff, &globals] { globals.run = [diff, &globals] { return run(*diff, globals); }; });
}

}  // namespace kinefile::cli
