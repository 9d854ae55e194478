// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "command.hpp"
#include "options.hpp"
#include "report.hpp"

namespace kinefile::cli {
namespace {

struct Fk {
  std::string file;
  std::string out = "-";
  std::string to;
  std::string frames;
  std::string joints;
  std::string unit = "file";
  bool is_rest = false;
  bool has_tips = false;
  bool has_rotations = false;
  bool has_directions = false;
  bool is_local = false;
  bool may_replace = false;
  bool is_comparing = false;
  Reading reading;
};

/// The joints of a comma-separated list, in skeleton order; all joints for an empty list. A name
/// that stands for no joint is returned in `unknown`.
std::vector<std::size_t> select_joints(const Skeleton& skeleton, const std::string& list,
                                       std::optional<std::string>& unknown) {
  std::vector<bool> is_selected(skeleton.joints.size(), list.empty());
  const auto names = list.empty() ? std::vector<std::string>{} : CLI::detail::split(list, ',');
  for (const std::string& name : names) {
    bool is_known = false;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
      if (skeleton.joints[j].name != name) continue;
      is_selected[j] = true;
      is_known = true;
    }
    if (!is_known && !unknown) unknown = name;
  }
  std::vector<std::size_t> selected;
  for (std::size_t j = 0; j < is_selected.size(); ++j) {
    if (is_selected[j]) selected.push_back(j);
  }
  return selected;
}

/// What `fk` places: a motion, and of a body motion the links that were recorded.
struct Placed {
  const Skeleton& skeleton;
  const Clip& clip;
  const BodyMotion* recorded = nullptr;
};

PoseArrays place(const Fk& fk, const Placed& placed, const FrameRange& range) {
  KinematicsOptions options;
  options.first_frame = range.begin;
  options.frame_step = range.step;
  options.num_frames = range.num_frames();
  options.rotations = fk.has_rotations;
  options.directions = fk.has_directions;
  options.tips = fk.has_tips;
  if (fk.is_local) return local_poses(placed.skeleton, placed.clip, options);
  PoseArrays poses = forward_kinematics(placed.skeleton, placed.clip, options);
  if (placed.recorded != nullptr)
    robot::put_recorded_links(*placed.recorded, placed.skeleton, poses);
  return poses;
}

/// Writes the table a block of frames at a time, so that a long clip needs little memory.
bool write_csv(const Fk& fk, const PoseTable& table, const Placed& placed, const FrameRange& range,
               const Sink& sink) {
  const std::size_t num_frames = range.num_frames();
  const std::size_t block = frames_per_block(*table.skeleton);
  bool is_good = write_pose_csv_header(table, sink);
  for (std::size_t done = 0; is_good && done < num_frames; done += block) {
    FrameRange part = range;
    part.begin = range.begin + done * range.step;
    part.end = part.begin + (std::min(block, num_frames - done) - 1) * range.step + 1;
    is_good = write_pose_csv(table, place(fk, placed, part), sink);
  }
  return is_good;
}

int write_table(const Fk& fk, const Globals& globals, const PoseTable& table, const Placed& placed,
                const FrameRange& range, bool is_json) {
  auto file = OutputFile::create(fk.out, fk.may_replace);
  if (!file) {
    print_error(file.error(), globals);
    return exit_code_of(file.error());
  }
  const Sink sink = [&file](std::string_view piece) { return file->write(piece); };
  if (is_json) {
    write_pose_json(table, place(fk, placed, range), sink);
  } else {
    write_csv(fk, table, placed, range, sink);
  }
  const auto committed = file->commit();
  if (committed) return kDone;
  print_error(committed.error(), globals);
  return exit_code_of(committed.error());
}

/// Finds out whether to write CSV or JSON; nothing for another format.
std::optional<bool> is_json_wanted(const Fk& fk) {
  if (!fk.to.empty()) return fk.to == "json";
  if (fk.out == "-") return false;
  const Format* format = format_of_name(fk.out);
  if (format == nullptr || (format->name != "csv" && format->name != "json")) return std::nullopt;
  return format->name == "json";
}

/// Reports what kept a command from its data, unless that is among diagnostics that were printed.
int report(Error error, const Diagnostics& diagnostics, const std::string& file,
           const Globals& globals) {
  if (error.place.source.empty()) error.place.source = file;
  if (!diagnostics.has_errors()) print_error(error, globals);
  return exit_code_of(error);
}

/// Tells how far kinematics and the recorded poses of links differ, a row a link.
int compare(const Fk& fk, const BodyMotion* body, const Globals& globals) {
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = fk.reading.is_strict;
  const auto model = load_skeleton(fk.reading, diagnostics);
  if (body == nullptr || !model || !*model) {
    if (!model) return report(model.error(), diagnostics, fk.file, globals);
    return usage_error(globals, "--compare needs a body motion and the model of --skeleton");
  }
  const auto deviations = robot::compare_recorded_links(*body, skeleton_of(**model),
                                                        fk.reading.is_lenient, diagnostics);
  print_diagnostics(stderr, diagnostics, globals);
  if (!deviations) return report(deviations.error(), diagnostics, fk.file, globals);
  if (finish_reading(fk.reading, globals, kDone) != kDone) return kUsage;
  std::string text = "link,distance,distance_frame,degrees,degrees_frame\n";
  for (const robot::LinkDeviation& deviation : *deviations) {
    text += fmt::format("{},{},{},{},{}\n", deviation.link, deviation.distance,
                        deviation.distance_frame, deviation.degrees, deviation.degrees_frame);
  }
  print_data(text);
  return diagnostics.has_errors() ? kInvalid : kDone;
}

int run(const Fk& fk, const Globals& globals) {
  const auto is_json = is_json_wanted(fk);
  if (!is_json) {
    return usage_error(globals, fmt::format("'{}' shows no format that poses are written in; "
                                            "name it .csv or .json, or say --to",
                                            fk.out));
  }
  int exit_code = kDone;
  auto document = load(fk.file, fk.reading, globals, exit_code);
  if (!document) return exit_code;
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = fk.reading.is_strict;
  const BodyMotion* body = std::get_if<BodyMotion>(&document->content);
  if (fk.is_comparing) return compare(fk, body, globals);
  const auto motion = motion_in_world(*document, fk.reading, diagnostics);
  print_diagnostics(stderr, diagnostics, globals);
  if (!motion) return report(motion.error(), diagnostics, fk.file, globals);
  if (diagnostics.has_errors()) return kInvalid;
  if (finish_reading(fk.reading, globals, kDone) != kDone) return kUsage;
  const Skeleton& skeleton = motion->skeleton;
  if (std::holds_alternative<Skeleton>(document->content) && !fk.is_rest) {
    return usage_error(globals, fmt::format("'{}' holds a skeleton alone; --rest shows its rest "
                                            "pose",
                                            fk.file));
  }
  const Clip rest = rest_clip(skeleton);
  const Clip& clip = fk.is_rest ? rest : motion->clip;
  const auto range = parse_range(fk.frames, clip.num_frames);
  if (!range) {
    return usage_error(globals, fmt::format("expected --frames A:B or A:B:STEP within 0:{}, found "
                                            "'{}'",
                                            clip.num_frames, fk.frames));
  }
  std::optional<std::string> unknown;
  PoseTable table{&skeleton,        &clip.timeline,    select_joints(skeleton, fk.joints, unknown),
                  fk.has_rotations, fk.has_directions, fk.has_tips};
  if (unknown) {
    return usage_error(globals, fmt::format("there is no joint '{}' in '{}'", *unknown, fk.file));
  }
  if (fk.unit == "m") {
    table.length_scale = skeleton.metres_per_unit;
    if (table.length_scale == 0) {
      return usage_error(globals,
                         "the file does not say its unit of length, so --unit m needs "
                         "--unit-in m|cm|mm|inch|FACTOR");
    }
  }
  const bool has_recorded = body != nullptr && !fk.is_rest && !fk.reading.skeleton.empty();
  const Placed placed{skeleton, clip, has_recorded ? body : nullptr};
  return write_table(fk, globals, table, placed, *range, *is_json);
}

}  // namespace

void add_fk(CLI::App& app, Globals& globals) {
  auto fk = std::make_shared<Fk>();
  CLI::App* command =
      app.add_subcommand("fk", "Place every joint in the world (forward kinematics)");
  command->add_option("FILE", fk->file, "File to read; - is standard input")->required();
  command->add_option("-o,--out", fk->out, "File to write, .csv or .json; else standard output")
      ->type_name("OUT");
  command->add_option("--to", fk->to, "Format of the output")
      ->check(CLI::IsMember({"csv", "json"}))
      ->type_name("FORMAT");
  CLI::Option* rest = command->add_flag("--rest", fk->is_rest, "The rest pose, as frame 0");
  command
      ->add_option("--frames", fk->frames, "Frames A to B, B not included; either may be left out")
      ->type_name("A:B[:STEP]")
      ->excludes(rest);
  command->add_option("--joints", fk->joints, "These joints alone")->type_name("A,B,...");
  command->add_flag("--tips", fk->has_tips, "A row NAME.tip after each joint that has a tip");
  command->add_flag("--rotations", fk->has_rotations, "Add the rotation, qw qx qy qz");
  command->add_flag("--direction", fk->has_directions, "Add the direction of the bone, ux uy uz");
  command->add_flag("--local", fk->is_local, "In the frame of each joint's parent");
  command->add_option("--unit", fk->unit, "Unit of lengths: the file's own, or metres")
      ->check(CLI::IsMember({"file", "m"}))
      ->default_str("file")
      ->type_name("UNIT");
  command->add_flag("--compare", fk->is_comparing,
                    "How far kinematics and the recorded poses of links differ at most, and in "
                    "which frame (.seq with --skeleton)");
  command->add_flag("--force", fk->may_replace, "Replace an existing file");
  add_reading_options(*command, fk->reading);
  command->callback([fk, &globals] { globals.run = [fk, &globals] { return run(*fk, globals); }; });
}

}  // namespace kinefile::cli
