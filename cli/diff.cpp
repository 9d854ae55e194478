// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "command.hpp"
#include "diff_components.hpp"
#include "diff_flows.hpp"
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

bool is_different(const MotionComparison& comparison, double tolerance) {
  return comparison.distance.value > tolerance || comparison.tip_distance.value > tolerance ||
         !comparison.only_in_first.empty() || !comparison.only_in_second.empty() ||
         comparison.num_frames_first != comparison.num_frames_second;
}

void print_names(std::string_view what, const std::vector<std::string>& names) {
  for (const std::string& name : names) print_data(fmt::format("{:<22}'{}'\n", what, name));
}

void print_motions(const Diff& diff, const MotionComparison& comparison) {
  print_largest("largest distance", comparison.distance, "");
  print_largest("largest tip distance", comparison.tip_distance, "");
  print_largest("largest rotation", comparison.rotation, " degrees");
  print_names("only in the first", comparison.only_in_first);
  print_names("only in the second", comparison.only_in_second);
  print_names("tips not compared", comparison.other_tips);
  if (comparison.num_frames_first != comparison.num_frames_second) {
    print_data(fmt::format("{:<22}{} and {}\n", "frames", comparison.num_frames_first,
                           comparison.num_frames_second));
  }
  print_data(is_different(comparison, diff.tolerance) ? "the motions differ\n"
                                                      : "the motions agree\n");
}

Json motions_json(const Diff& diff, const MotionComparison& comparison) {
  return {{"is_different", is_different(comparison, diff.tolerance)},
          {"distance", json_of(comparison.distance)},
          {"tip_distance", json_of(comparison.tip_distance)},
          {"rotation_degrees", json_of(comparison.rotation)},
          {"only_in_first", comparison.only_in_first},
          {"only_in_second", comparison.only_in_second},
          {"tips_not_compared", comparison.other_tips},
          {"num_frames", {comparison.num_frames_first, comparison.num_frames_second}}};
}

/// The motion of a document; a skeleton alone is compared in its rest pose.
Motion motion_of(Document&& document) {
  if (Motion* motion = std::get_if<Motion>(&document.content)) return std::move(*motion);
  Motion rest;
  rest.skeleton = skeleton_of(document);
  rest.clip = rest_clip(rest.skeleton);
  return rest;
}

/// Prints what a comparison found. Returns the exit code.
template <class Comparison>
int tell(const Comparison& comparison, bool is_different, bool is_json) {
  if (is_json) {
    print_json(json_of(comparison));
  } else {
    print_text(comparison);
  }
  return is_different ? kInvalid : kDone;
}

int run(const Diff& diff, const Globals& globals) {
  int exit_code = kDone;
  auto first = load(diff.first, diff.reading, globals, exit_code);
  auto second = load(diff.second, diff.reading, globals, exit_code);
  if (!first || !second) return exit_code;
  exit_code = finish_reading(diff.reading, globals, exit_code);
  if (exit_code != kDone) return exit_code;
  const BodyMotion* a = std::get_if<BodyMotion>(&first->content);
  const BodyMotion* b = std::get_if<BodyMotion>(&second->content);
  if (a != nullptr && b != nullptr) {
    const BodyComparison comparison = compare_components(*a, *b, diff.tolerance);
    return tell(comparison, comparison.is_different, diff.is_json);
  }
  const PoseFlow* flow_a = std::get_if<PoseFlow>(&first->content);
  const PoseFlow* flow_b = std::get_if<PoseFlow>(&second->content);
  if (flow_a != nullptr && flow_b != nullptr) {
    const auto differences = compare_flows(*flow_a, *flow_b);
    return tell(differences, !differences.empty(), diff.is_json);
  }
  if (!has_skeleton(*first) || !has_skeleton(*second)) {
    return usage_error(
        globals, "diff compares two motions, two body motions or two flows; convert one first");
  }
  const MotionComparison comparison =
      compare_motions(motion_of(std::move(*first)), motion_of(std::move(*second)));
  if (diff.is_json) {
    print_json(motions_json(diff, comparison));
  } else {
    print_motions(diff, comparison);
  }
  return is_different(comparison, diff.tolerance) ? kInvalid : kDone;
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
