// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "json_output.hpp"
#include "numbers.hpp"
#include "options.hpp"
#include "report.hpp"
#include "signals.hpp"
#include "skeleton_source.hpp"
#include "writing.hpp"

namespace kinefile::cli {
namespace {

struct Keyframe {
  std::string file;
  std::string servo_map;
  std::string flow_format = "v1r4";
  bool is_json = false;
  servo::KeyframeOptions options;
  Writing writing;
  Reading reading;
};

double seconds_of_pose(const servo::Keyframes& made, const ServoMap& map) {
  return static_cast<double>(made.ticks.back()) * map.tick_seconds;
}

void print_table(const Keyframe& keyframe, const servo::Keyframes& made, const ServoMap& map) {
  const int lead_in = keyframe.options.lead_in_ticks;
  print_message(fmt::format("{} pose{}, {:.3f} s after {} tick{} of lead-in\n", made.ticks.size(),
                            made.ticks.size() == 1 ? "" : "s", seconds_of_pose(made, map), lead_in,
                            lead_in == 1 ? "" : "s"));
  print_message(
      fmt::format("{:<24}{:>10}{:>10}{:>10}  degrees\n", "joint", "largest", "at s", "RMS"));
  for (const servo::KeyframeError& error : made.errors) {
    print_message(fmt::format("{:<24}{:>10.3f}{:>10.3f}{:>10.3f}\n", error.joint, error.largest,
                              error.largest_seconds, error.rms));
  }
}

Json json_of_keyframes(const Keyframe& keyframe, const servo::Keyframes& made,
                       const ServoMap& map) {
  Json joints = Json::array();
  double largest = 0;
  for (const servo::KeyframeError& error : made.errors) {
    largest = std::max(largest, error.largest);
    joints.push_back({{"joint", error.joint},
                      {"largest_degrees", error.largest},
                      {"largest_seconds", error.largest_seconds},
                      {"rms_degrees", error.rms}});
  }
  return {{"num_poses", made.ticks.size()},
          {"lead_in_ticks", keyframe.options.lead_in_ticks},
          {"ticks", made.ticks},
          {"duration", seconds_of_pose(made, map)},
          {"largest_degrees", largest},
          {"joints", joints}};
}

bool is_for_flows_alone(const Format& format) {
  const Kinds& writes = format.conventions.writes;
  return writes.flows && !writes.motions && !writes.skeletons && !writes.body_motions;
}

int run(const Keyframe& keyframe, const Globals& globals) {
  const Format* format = output_format(keyframe.writing);
  if (format == nullptr && keyframe.writing.to.empty()) format = first_format(is_for_flows_alone);
  if (format == nullptr) return no_output_format(keyframe.writing, globals);
  if (keyframe.is_json && keyframe.writing.out == "-") {
    return usage_error(globals, "--json and -o - would both go to standard output");
  }
  int exit_code = kDone;
  const auto document = load(keyframe.file, keyframe.reading, globals, exit_code);
  if (!document) return exit_code;
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = keyframe.reading.is_strict;
  const auto finish = [&](Error error) {
    print_diagnostics(STDERR_FILENO, diagnostics, globals);
    return print_failure(std::move(error), diagnostics, keyframe.file, globals);
  };
  if (const auto effect = expect_options_of(keyframe.reading, {&format, 1}); !effect) {
    return finish(effect.error());
  }
  const auto map = read_servo_map(keyframe.servo_map, diagnostics);
  if (!map) return finish(map.error());
  const auto made = kinefile::keyframe(*document, *map, source_of_skeleton(keyframe.reading),
                                       keyframe.options, diagnostics);
  if (!made) return finish(made.error());
  if (const auto used = expect_skeleton_used(keyframe.reading); !used) return finish(used.error());
  if (diagnostics.has_errors()) return finish(diagnostics.first_error());
  Document flow;
  flow.content = made->flow;
  auto fitting = in_kind_of(*format, std::move(flow), {}, diagnostics);
  if (!fitting) return finish(fitting.error());
  const auto written = write_file(keyframe.writing.out, *fitting, *format, keyframe.writing.format,
                                  output_options(keyframe.writing.may_replace), diagnostics);
  if (!written) return finish(written.error());
  print_diagnostics(STDERR_FILENO, diagnostics, globals);
  if (keyframe.is_json) {
    print_json(json_of_keyframes(keyframe, *made, *map));
  } else if (!globals.is_quiet) {
    print_table(keyframe, *made, *map);
  }
  return kDone;
}

std::string check_degrees(const std::string& text) {
  double tolerance = 0;
  const bool is_number = CLI::detail::lexical_cast(text, tolerance);
  return is_number && tolerance >= 0 && std::isfinite(tolerance) ? ""
                                                                 : "expected degrees from 0 up";
}

}  // namespace

void add_keyframe(CLI::App& app, Globals& globals) {
  auto keyframe = std::make_shared<Keyframe>();
  CLI::App* command =
      app.add_subcommand("keyframe", "Make a flow of servo poses that follows a motion");
  command->add_option("MOTION", keyframe->file, "File to read; - is standard input")->required();
  command
      ->add_option("--servo-map", keyframe->servo_map,
                   "A YAML file that says which slider moves which joint, and how")
      ->required()
      ->type_name("FILE");
  CLI::Option* poses =
      command
          ->add_option("--poses", keyframe->options.num_poses,
                       "At most so many poses, with the least largest error")
          ->check([](const std::string& text) { return check_count(text, 1, 1'000'000); })
          ->type_name("N");
  command
      ->add_option("--tolerance", keyframe->options.tolerance,
                   "As few poses as stay within so many degrees of the motion, at every tick")
      ->check(check_degrees)
      ->excludes(poses)
      ->type_name("DEGREES");
  command
      ->add_option("--flow-format", keyframe->flow_format,
                   "v1r4 (RobovieMaker2) or word_n (RobovieMaker for VS-RC003)")
      ->check(CLI::IsMember({"v1r4", "word_n"}))
      ->default_str("v1r4")
      ->type_name("FORMAT");
  command
      ->add_option("--lead-in", keyframe->options.lead_in_ticks,
                   "Ticks of the first pose, in which the robot comes to the motion's first frame")
      ->check(CLI::Range(1, kMaxTicks))
      ->default_str("60")
      ->type_name("TICKS");
  command->add_flag("--json", keyframe->is_json, "Print the report as an object");
  command->add_option("-o,--out", keyframe->writing.out, "File to write; - is standard output")
      ->required()
      ->type_name("OUT");
  add_writing_options(*command, keyframe->writing);
  add_reading_options(*command, keyframe->reading);
  command->callback([keyframe, command, &globals] {
    if (keyframe->flow_format == "word_n") keyframe->options.format = FlowFormat::WordN;
    // Frames with times are interpolated at the ticks, unless --timed-rounding moves them to frames
    // at a steady rate.
    if (command->count("--timed-rounding") == 0) keyframe->reading.options.keeps_times = true;
    globals.run = [keyframe, &globals] { return run(*keyframe, globals); };
  });
}

}  // namespace kinefile::cli
