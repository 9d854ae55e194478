// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "command.hpp"
#include "folders.hpp"
#include "info_flow.hpp"
#include "json_output.hpp"
#include "many.hpp"
#include "options.hpp"
#include "report.hpp"

namespace kinefile::cli {
namespace {

struct Options {
  std::vector<std::string> files;
  bool is_tree = false;
  bool is_json = false;
  bool has_poses = false;
  bool is_recursive = false;
  std::size_t num_jobs = 0;
  Reading reading;
};

void print_subtree(const Skeleton& skeleton, const std::vector<std::vector<std::size_t>>& children,
                   std::string& out) {
  struct Line {
    std::size_t joint;
    std::string indent;
    bool is_root;
    bool is_last;
  };
  std::vector<Line> waiting;
  for (std::size_t j = skeleton.joints.size(); j-- > 0;) {
    if (skeleton.joints[j].parent == kNoParent) waiting.push_back({j, "", true, true});
  }
  while (!waiting.empty()) {
    const Line line = std::move(waiting.back());
    waiting.pop_back();
    out += fmt::format("{}{}{}\n", line.indent, line.is_root ? "" : "+- ",
                       printable(skeleton.joints[line.joint].name));
    const std::string indent = line.is_root ? "" : line.indent + (line.is_last ? "   " : "|  ");
    const auto& below = children[line.joint];
    for (std::size_t c = below.size(); c-- > 0;) {
      waiting.push_back({below[c], indent, false, c + 1 == below.size()});
    }
  }
}

std::string tree_of(const Skeleton& skeleton) {
  std::string tree;
  print_subtree(skeleton, children_of_joints(skeleton), tree);
  return tree;
}

/// The rotation orders and the number of joints with each: "ZXY on 20 joints, Z on 2 joints".
std::string order_text(const std::vector<RotationOrderInfo>& orders) {
  std::string text;
  for (const RotationOrderInfo& order : orders) {
    text += fmt::format("{}{} on {} {}", text.empty() ? "" : ", ", order.order, order.num_joints,
                        order.num_joints == 1 ? "joint" : "joints");
  }
  return text.empty() ? "none" : text;
}

std::string box_text(const Box& box) {
  if (box.min.x() > box.max.x()) return "nothing finite";
  return fmt::format("x {:.6g} to {:.6g}, y {:.6g} to {:.6g}, z {:.6g} to {:.6g}", box.min.x(),
                     box.max.x(), box.min.y(), box.max.y(), box.min.z(), box.max.z());
}

/// A certainty and a reason, for people.
std::string because(Certainty certainty, const std::string& reason) {
  if (certainty == Certainty::Known) return "";
  return fmt::format("; a {}guess: {}", certainty == Certainty::Doubtful ? "doubtful " : "",
                     reason);
}

/// A direction as a coordinate axis if it is within a degree of one: "+z".
std::string direction_text(const Vec3& direction) {
  constexpr double kCosineOfOneDegree = 0.99985;
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (std::abs(direction[k]) < kCosineOfOneDegree) continue;
    return fmt::format("{}{}", direction[k] < 0 ? '-' : '+', "xyz"[k]);
  }
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", direction.x(), direction.y(), direction.z());
}

std::string facing_text(const Facing& facing) {
  if (!facing.direction) return fmt::format("not known: {}", facing.reason);
  return fmt::format("{}; a guess: {}", direction_text(*facing.direction), facing.reason);
}

std::string unit_text(const LengthUnit& unit) {
  if (unit.certainty == Certainty::Known) return fmt::format("length unit {} m", unit.metres);
  return fmt::format("length unit not in the file, {} m is likely{}", unit.metres,
                     because(unit.certainty, unit.reason));
}

/// The exact rate, and beside it the nominal one where they differ by more than arithmetic.
std::string rate_text(const TimeInfo& time) {
  constexpr double kRounding = 1e-11;
  const double nominal = time.nominal_frame_rate;
  if (!(std::abs(time.frame_rate - nominal) > kRounding * nominal)) {
    return fmt::format("{:.6g} fps", time.frame_rate);
  }
  return fmt::format("{:.12g} fps, nominally {:.6g} fps", time.frame_rate, nominal);
}

/// A description of a component of a body motion.
std::string component_text(const ComponentInfo& info) {
  if (info.kind == ComponentKind::Other) {
    return fmt::format("{}, kept as it stands", info.type.empty() ? "of unknown type" : info.type);
  }
  constexpr std::string_view kParts[] = {"value", "pose", "vector"};
  const std::string_view part = kParts[static_cast<std::size_t>(info.kind)];
  const double rate = info.time.frame_rate;
  return fmt::format(
      "{}: {} frames of {} {}{}{}{}{}", info.content, info.time.num_frames, info.num_parts, part,
      info.num_parts == 1 ? "" : "s", info.time.has_own_times ? ", at times of their own" : "",
      rate > 0 ? fmt::format(", {}, duration {} s", rate_text(info.time), info.time.duration) : "",
      info.is_root_relative ? ", relative to the root link" : "");
}

std::string text_of(const std::string& path, const Document& document) {
  const Info told = info(document);
  std::string text = fmt::format("{}: {} {}\n", path, told.format, told.kind);
  const auto line = [&text](std::string_view key, const std::string& value) {
    text += fmt::format("  {:<12}{}\n", key, value);
  };
  line("dialect", dialect_text(told.facts));
  if (told.body) {
    for (const ComponentInfo& component : told.body->components) {
      line("component", component_text(component));
    }
    return text;
  }
  const SkeletonInfo& skeleton = *told.skeleton;
  line("joints", fmt::format("{} ({} {}, {} {})", skeleton.num_joints, skeleton.num_roots,
                             skeleton.num_roots == 1 ? "root" : "roots", skeleton.num_tips,
                             skeleton.num_tips == 1 ? "tip" : "tips"));
  line("dofs", fmt::format("{} in {} columns", skeleton.num_dofs, skeleton.num_columns));
  line("rotations", order_text(skeleton.rotation_orders));
  line("positions", fmt::format("on {} of {} joints", skeleton.num_joints_with_translations,
                                skeleton.num_joints));
  if (told.motion) {
    const TimeInfo& time = told.motion->time;
    const auto first = time.first_frame_number;
    line("frames",
         fmt::format("{}{}", time.num_frames,
                     first == 0 ? "" : fmt::format(", the first is {} in the file", first)));
    line("rate", fmt::format("{}, frame time {} s{}", rate_text(time), time.frame_time,
                             time.has_own_times ? ", frames at times of their own" : ""));
    line("duration", fmt::format("{} s", time.duration));
  }
  const EvidenceInfo& evidence = *told.evidence;
  line("units",
       fmt::format("{}, {}", skeleton.angle_unit == AngleUnit::Degrees ? "degrees" : "radians",
                   unit_text(evidence.unit)));
  line("up", fmt::format("{}{}", "xyz"[evidence.up.axis],
                         because(evidence.up.certainty, evidence.up.reason)));
  line("facing", facing_text(evidence.facing));
  line("rest extent", box_text(skeleton.rest_extent));
  if (told.motion) line("extent", box_text(told.motion->extent));
  return text;
}

Json number(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

Json box_json(const Box& box) {
  if (box.min.x() > box.max.x()) return nullptr;
  return {{"min", {box.min.x(), box.min.y(), box.min.z()}},
          {"max", {box.max.x(), box.max.y(), box.max.z()}}};
}

const char* name_of(Certainty certainty) {
  constexpr const char* kNames[] = {"known", "clear", "doubtful"};
  return kNames[static_cast<std::size_t>(certainty)];
}

/// Adds what is known or guessed of the axes and the unit, each with its reason.
void add_evidence(Json& json, const EvidenceInfo& info) {
  json["up"] = {{"axis", std::string(1, "xyz"[info.up.axis])},
                {"certainty", name_of(info.up.certainty)},
                {"reason", info.up.reason}};
  Json direction;
  if (const auto& facing = info.facing.direction) {
    direction = {number(facing->x()), number(facing->y()), number(facing->z())};
  }
  json["facing"] = {{"direction", direction}, {"reason", info.facing.reason}};
  json["length_unit"] = {{"metres", number(info.unit.metres)},
                         {"certainty", name_of(info.unit.certainty)},
                         {"reason", info.unit.reason}};
}

std::string type_of(const ComponentInfo& info) {
  constexpr const char* kTypes[] = {"MultiValueSeq", "MultiSE3Seq", "Vector3Seq"};
  return info.kind == ComponentKind::Other ? info.type
                                           : kTypes[static_cast<std::size_t>(info.kind)];
}

Json json_of_component(const ComponentInfo& info) {
  Json json = {{"type", type_of(info)},
               {"content", info.content},
               {"num_parts", info.num_parts},
               {"num_frames", info.time.num_frames},
               {"frame_rate", number(info.time.frame_rate)},
               {"nominal_frame_rate", number(info.time.nominal_frame_rate)}};
  if (info.kind == ComponentKind::Vectors) json["is_root_relative"] = info.is_root_relative;
  return json;
}

/// Adds the length and rate of a body motion: those of its main component.
void add_body(Json& json, const BodyInfo& info) {
  if (info.time) {
    json["num_frames"] = info.time->num_frames;
    json["frame_time"] = number(info.time->frame_time);
    json["frame_rate"] = number(info.time->frame_rate);
    json["nominal_frame_rate"] = number(info.time->nominal_frame_rate);
    json["duration"] = number(info.time->duration);
  }
  json["angle_unit"] = "radians";
  json["metres_per_unit"] = 1;
  json["components"] = Json::array();
  for (const ComponentInfo& component : info.components) {
    json["components"].push_back(json_of_component(component));
  }
}

void add_motion(Json& json, const MotionInfo& info) {
  json["num_frames"] = info.time.num_frames;
  json["first_frame_number"] = info.time.first_frame_number;
  json["frame_time"] = number(info.time.frame_time);
  json["frame_rate"] = number(info.time.frame_rate);
  json["nominal_frame_rate"] = number(info.time.nominal_frame_rate);
  json["duration"] = number(info.time.duration);
  json["extent"] = box_json(info.extent);
}

/// The joints, each with its parent.
Json joints_json(const Skeleton& skeleton) {
  Json joints = Json::array();
  for (const Joint& joint : skeleton.joints) {
    const Json parent =
        joint.parent == kNoParent ? Json() : Json(skeleton.joints[joint.parent].name);
    joints.push_back({{"name", joint.name}, {"parent", parent}});
  }
  return joints;
}

Json json_of_document(const std::string& path, const Document& document) {
  const Info told = info(document);
  Json json = file_json(path, told);
  if (told.body) {
    add_body(json, *told.body);
    return json;
  }
  const SkeletonInfo& skeleton = *told.skeleton;
  json["num_joints"] = skeleton.num_joints;
  json["num_dofs"] = skeleton.num_dofs;
  json["num_columns"] = skeleton.num_columns;
  json["num_tips"] = skeleton.num_tips;
  if (told.motion) add_motion(json, *told.motion);
  json["angle_unit"] = skeleton.angle_unit == AngleUnit::Degrees ? "degrees" : "radians";
  json["metres_per_unit"] = skeleton.metres_per_unit > 0 ? Json(skeleton.metres_per_unit) : Json();
  add_evidence(json, *told.evidence);
  json["rest_extent"] = box_json(skeleton.rest_extent);
  json["joints"] = joints_json(skeleton_of(document));
  return json;
}

/// What is told of one file, and what reading it used.
struct Told {
  Diagnostics diagnostics;
  std::optional<Error> error;
  std::string text;
  Json json;
  std::string refusal;  ///< why the request does not fit the file; empty: it does
  std::vector<const Format*> formats;
  bool is_skeleton_used = false;
  std::shared_ptr<const RobotProject> project;
};

void tell_flow(const std::string& name, const Document& document, const Options& options,
               Told& told) {
  const Info about = info(document, {options.has_poses, told.project.get()});
  if (options.is_json) {
    told.json = flow_json(name, about, options.has_poses);
    return;
  }
  told.text = flow_text(name, about);
  if (options.has_poses) told.text += poses_text(about.flow->poses);
}

void tell(const std::string& name, const Document& document, const Options& options, Told& told) {
  const bool is_flow = std::holds_alternative<PoseFlow>(document.content);
  if (options.has_poses && !is_flow) {
    told.refusal = fmt::format("'{}' holds no flow of poses", name);
  } else if (is_flow && (options.is_json || !options.is_tree)) {
    tell_flow(name, document, options, told);
  } else if (options.is_json) {
    told.json = json_of_document(name, document);
  } else if (!options.is_tree) {
    told.text = text_of(name, document);
  } else if (has_skeleton(document)) {
    told.text = tree_of(skeleton_of(document));
  } else {
    told.refusal = fmt::format("'{}' holds no skeleton to draw", name);
  }
}

std::string name_of(const InputFile& file) { return file.path == "-" ? "<stdin>" : file.path; }

/// Tells of a file. Called for several files at once.
Told told_of(const InputFile& file, const Options& options, const Reading& shared) {
  Told told;
  if (!file.is_known) {
    told.diagnostics.add(unknown_format(file.path));
    return told;
  }
  const Reading reading = shared;
  const auto document = load_quietly(file.path, reading, told.diagnostics);
  told.project = reading.loaded_project;
  if (document) {
    tell(name_of(file), *document, options, told);
  } else {
    told.error = document.error();
  }
  told.formats = reading.formats;
  told.is_skeleton_used = reading.is_skeleton_used;
  return told;
}

/// Prints what was told of a file, or adds it to the array for JSON.
/// \returns the exit code
int print_told(const InputFile& file, bool has_title, Told&& told, const Options& options,
               const Globals& globals, Json& all) {
  print_diagnostics(STDERR_FILENO, told.diagnostics, globals);
  for (const Format* format : told.formats) note_format(format, options.reading);
  options.reading.is_skeleton_used |= told.is_skeleton_used;
  if (told.error) {
    if (!told.diagnostics.has_errors()) print_error(*told.error, globals);
    return exit_code_of(*told.error);
  }
  if (has_title && file.is_known) print_lines(fmt::format("{}:\n", name_of(file)));
  print_lines(told.text);
  if (!told.json.is_null()) all.push_back(std::move(told.json));
  return told.refusal.empty() ? kDone : usage_error(globals, told.refusal);
}

/// Reports what is to be said of a path besides its files.
/// \returns the exit code
int print_path(const std::string& path, const Result<FolderFiles>& found, const Globals& globals) {
  if (!found) {
    print_error(found.error(), globals);
    return exit_code_of(found.error());
  }
  if (found->num_folders > 0) {
    Diagnostics diagnostics;
    diagnostics.add(folders_passed_over(path, found->num_folders));
    print_diagnostics(STDERR_FILENO, diagnostics, globals);
  }
  return is_without_files(path, *found) ? usage_error(globals, no_files_in(path)) : kDone;
}

int run(const Options& options, const Globals& globals) {
  set_max_threads(options.num_jobs);
  int exit_code = kDone;
  Json all = Json::array();
  const GivenFiles given = files_at_all(options.files, {options.is_recursive});
  for (std::size_t i = 0; i < given.paths.size(); ++i) {
    exit_code = worse(exit_code, print_path(options.files[i], given.paths[i], globals));
  }
  const bool has_titles = options.is_tree && !options.is_json && given.files.size() > 1;
  Reading shared = options.reading;
  // The first file reads the project for all.
  const Batch batch{given.files.size(), [&, inner = batch_of(given)](std::size_t i) {
                      return (i == 0 && !shared.project.empty()) || inner.is_alone(i);
                    }};
  const bool fits = for_each_input<Told>(
      batch, [&](std::size_t i) { return told_of(given.file(i), options, shared); },
      [&](std::size_t i, Told&& told) {
        if (i == 0) shared.loaded_project = told.project;
        const bool is_refused = !told.refusal.empty();
        exit_code = worse(exit_code, print_told(given.file(i), has_titles, std::move(told), options,
                                                globals, all));
        return !is_refused;
      });
  if (!fits) return kUsage;
  if (options.is_json) print_json(all);
  return finish_reading(options.reading, globals, exit_code);
}

}  // namespace

void add_info(CLI::App& app, Globals& globals) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("info", "Tell what files hold");
  command
      ->add_option("FILE", options->files, "Files to read, or folders of such; - is standard input")
      ->required();
  command->add_flag("--tree", options->is_tree, "Draw the hierarchy of joints, and no more");
  command->add_flag("--poses", options->has_poses,
                    "Of a flow of servo poses: also print its poses, with --project in degrees");
  command->add_flag("--json", options->is_json, "Print an array with an object a file");
  command->add_flag("--recursive", options->is_recursive, "Read the folders in folders, too");
  add_jobs_option(*command, options->num_jobs);
  add_reading_options(*command, options->reading);
  options->reading.options.keeps_times_without_rate = true;
  command->callback([options, &globals] {
    globals.run = [options, &globals] { return run(*options, globals); };
  });
}

}  // namespace kinefile::cli
