// SPDX-License-Identifier: MIT
#include "session.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>
#include <vector>

#include "clock.hpp"
#include "kinefile/io.hpp"
#include "kinefile/place.hpp"
#include "kinefile/retime_documents.hpp"
#include "kinefile/robot.hpp"
#include "kinefile/run.hpp"
#include "sliders.hpp"

namespace kinefile::page {
namespace {

bool is_lenient(const Opening& opening) { return opening.options.value("lenient", false); }

Result<std::string_view> bytes_of(const FileSet& files, const std::string& path) {
  const auto found = files.find(path);
  if (found != files.end()) return view(*found->second);
  return fail(make_error(ErrorKind::Io, "IO001", "there is no such file", path));
}

/// The options for reading a file, except for what it is read with.
Result<ReadOptions> read_options(const Opening& opening) {
  ReadOptions options;
  options.keeps_times_without_rate = true;
  Json words = opening.options;
  options.lenient = words.value("lenient", false);
  words.erase("lenient");
  words.erase("from");  // names the format, see `Opening`
  std::vector<std::span<const ReadOption>> tables;
  for (const Format& format : formats()) tables.push_back(format.read_options);
  auto set = set_options<ReadOptions>(options, words, tables);
  if (!set) return fail(std::move(set.error()));
  return options;
}

/// Reads one file of the set.
Result<Document> read(const FileSet& files, const std::string& path, const Format* format,
                      ReadOptions options, std::set<std::string>& opened,
                      Diagnostics& diagnostics) {
  const auto bytes = bytes_of(files, path);
  if (!bytes) return fail(bytes.error());
  options.companions = files_beside(files, path, opened);
  return read_bytes(*bytes, path, format, std::move(options), diagnostics);
}

/// Reads the skeleton or the robot that the opening names; null if it names none.
Result<std::shared_ptr<const Document>> read_model(const FileSet& files, Slot& slot,
                                                   const ReadOptions& options,
                                                   Diagnostics& diagnostics) {
  const std::string& path = slot.opening.skeleton;
  if (path.empty()) return nullptr;
  ReadOptions of_model;
  of_model.lenient = options.lenient;
  of_model.of_formats = options.of_formats;
  of_model.metres_per_unit = options.metres_per_unit;
  of_model.up = options.up;
  slot.opened.insert(path);
  auto model = read(files, path, nullptr, of_model, slot.opened, diagnostics);
  if (!model) return fail(std::move(model.error()));
  return std::make_shared<const Document>(std::move(*model));
}

/// The servo map that the opening names, otherwise the one of its project; nothing without both.
Result<std::optional<ServoMap>> servo_map_for(const FileSet& files, Slot& slot,
                                              const RobotProject* project,
                                              Diagnostics& diagnostics) {
  const std::string& path = slot.opening.servo_map;
  if (path.empty()) {
    return project == nullptr ? std::nullopt : std::optional(servo_map_of(*project));
  }
  const auto bytes = bytes_of(files, path);
  if (!bytes) return fail(bytes.error());
  slot.opened.insert(path);
  auto map = parse_servo_map(*bytes, path, diagnostics);
  if (!map) return fail(std::move(map.error()));
  return std::optional(std::move(*map));
}

/// The last part of a path.
std::string name_of_file(const std::string& path) { return path.substr(path.rfind('/') + 1); }

/// The poses of a run, in its order.
std::vector<PlayedBlock> blocks_of(const flow::Run& run, const PoseFlow& flow) {
  constexpr std::size_t kMost = 5000;  // more cannot be seen on a timeline
  std::vector<PlayedBlock> blocks;
  for (const flow::Step& step : run.path) {
    const Block& block = flow.blocks[step.block];
    if (!std::holds_alternative<PoseBlock>(block.body) || blocks.size() == kMost) continue;
    blocks.push_back({step.tick, step.block, block.name});
  }
  return blocks;
}

constexpr const char* kNeeds = "to see a figure, a flow of servo poses needs ";

/// What a flow lacks to be shown on a robot; empty: nothing.
std::string lacked(bool has_robot, bool has_map) {
  constexpr const char* kRobot = "the robot's model (.body, .wrl, .urdf)";
  constexpr const char* kMap = "a servo map (.yaml) or the robot's project (.rpj)";
  if (has_robot) return has_map ? "" : std::string(kNeeds) + kMap;
  return kNeeds + (has_map ? kRobot : kRobot + std::string(" and ") + kMap);
}

/// The motion of a robot that a flow makes through a servo map. A map that is made of the project
/// has its names of sliders, which need not be those of the robot's joints: then it is none.
Result<Document> moved_robot(Slot& slot, const TimedRun& timed, const ServoMap& map,
                             Diagnostics& diagnostics) {
  ServoMap timed_map = map;
  timed_map.tick_seconds = timed.tick_seconds;
  Diagnostics own;
  auto document = document_of_run(timed, timed_map, source_of_model(slot), own);
  if (!document && document.error().code == "SVM010" && slot.opening.servo_map.empty()) {
    slot.lacks = std::string(kNeeds) +
                 "a servo map (.yaml), since no joint of the robot has the name of a slider of the "
                 "project";
  } else {
    diagnostics.append(std::move(own));
  }
  return document;
}

/// Runs a flow through a servo map, so that it has a motion: of its robot, or of its sliders alone
/// where something is missing. Other documents stay as they are.
Result<Document> moving(const Session& session, Slot& slot, const Document& document,
                        Diagnostics& diagnostics) {
  const PoseFlow* flow = std::get_if<PoseFlow>(&document.content);
  if (flow == nullptr) return document;
  auto project = project_of(session, slot, diagnostics);
  if (!project) return fail(std::move(project.error()));
  auto map = servo_map_for(session.files, slot, project->get(), diagnostics);
  if (!map) return fail(std::move(map.error()));
  RunSettings settings;
  settings.project = *project;
  settings.servo_map = *map;
  const auto timed = run(*flow, settings, diagnostics);
  if (!timed) return fail(timed.error());
  slot.blocks = blocks_of(timed->run, *flow);
  slot.lacks = lacked(slot.model != nullptr, map->has_value());
  if (slot.lacks.empty()) {
    auto moved = moved_robot(slot, *timed, **map, diagnostics);
    if (slot.lacks.empty()) return moved;
  }
  Document sliders;
  sliders.content = motion_of_sliders(*timed, *flow, project->get());
  std::get<Motion>(sliders.content).skeleton.joints[0].name = name_of_file(slot.opening.path);
  return sliders;
}

/// Places the current document in the world.
Result<void> place_current(const Session& session, Slot& slot, Diagnostics& diagnostics) {
  const bool lenient = is_lenient(slot.opening);
  auto document = moving(session, slot, slot.current, diagnostics);
  if (!document) return fail(std::move(document.error()));
  slot.played = std::move(*document);
  auto placed = place(slot.played, source_of_model(slot), lenient, diagnostics);
  if (!placed) return fail(std::move(placed.error()));
  FkOptions options;
  options.name = slot.opening.path;
  options.rest = placed->is_still || placed->motion.clip.num_frames == 0;
  options.rotations = options.tips = true;
  auto table = fk(std::move(*placed), options);
  if (!table) return fail(std::move(table.error()));
  slot.table = std::move(*table);
  return {};
}

/// Applies one step of kind "warp".
Result<void> warp(Slot& slot, const Json& words, Diagnostics& diagnostics) {
  retime::DocumentWarp warp;
  retime::RetimeOptions retiming;
  Json of_map = Json::object(), of_motion = Json::object();
  for (const auto& [name, word] : words.items()) {
    const bool is_of_map = find_option(retime::warp_options(), name) != nullptr;
    (is_of_map ? of_map : of_motion)[name] = word;
  }
  const std::span<const Option<retime::DocumentWarp>> map_table[] = {retime::warp_options()};
  auto set = set_options<retime::DocumentWarp>(warp, of_map, map_table);
  const std::span<const Option<retime::RetimeOptions>> table[] = {retime::retime_options()};
  if (set) set = set_options<retime::RetimeOptions>(retiming, of_motion, table);
  if (!set) return set;
  auto map = retime::warp_map(slot.current, warp, diagnostics);
  if (!map) return fail(std::move(map.error()));
  slot.source_frames = map->old_frames;
  auto applied = retime::apply(slot.current, *map, retiming, diagnostics);
  if (!applied) return applied;
  turn_clock(slot.clock, slot.current, [&](Document& clock) {
    Diagnostics ignored;
    return retime::apply(clock, *map, retiming, ignored).has_value();
  });
  return {};
}

/// Applies one operation of the table.
Result<void> operate(const Session& session, Slot& slot, const std::string& word,
                     Diagnostics& diagnostics) {
  const auto operation = parse_operation(word);
  if (!operation) return fail(operation.error());
  OperationContext context;
  context.lenient = is_lenient(slot.opening);
  context.open = [&](const std::string& name) {
    std::set<std::string> opened;
    return read(session.files, name, nullptr, {}, opened, diagnostics);
  };
  auto project = project_of(session, slot, diagnostics);
  if (!project) return fail(std::move(project.error()));
  context.project = std::move(*project);
  auto applied = apply(std::span(&*operation, 1), slot.current, context, diagnostics);
  if (!applied || !operation->info->works_on_components) return applied;
  turn_clock(slot.clock, slot.current, [&](Document& clock) {
    Diagnostics ignored;
    OperationContext of_clock = context;
    of_clock.open = [&](const std::string& name) -> Result<Document> {
      auto other = context.open(name);
      if (!other) return other;
      auto times = clock_of(*other);
      if (!times) return fail(ErrorKind::Usage, "CLI001", "no frames");
      return std::move(*times);
    };
    return apply(std::span(&*operation, 1), clock, of_clock, ignored).has_value();
  });
  return applied;
}

}  // namespace

Result<std::shared_ptr<const RobotProject>> project_of(const Session& session, Slot& slot,
                                                       Diagnostics& diagnostics) {
  const std::string& path = slot.opening.project;
  if (path.empty()) return nullptr;
  const auto bytes = bytes_of(session.files, path);
  if (!bytes) return fail(bytes.error());
  slot.opened.insert(path);
  ReadOptions options;
  options.source_name = path;
  options.lenient = is_lenient(slot.opening);
  options.companions = files_beside(session.files, path, slot.opened);
  auto project = read_project(*bytes, options, diagnostics);
  if (!project) return fail(std::move(project.error()));
  return std::make_shared<const RobotProject>(std::move(*project));
}

DocumentSource source_of_model(const Slot& slot) {
  if (slot.model == nullptr) return {};
  return [model = slot.model](Diagnostics&) -> Result<std::shared_ptr<const Document>> {
    return model;
  };
}

bool is_of_robot(const Slot& slot) {
  const bool is_on_robot = slot.model != nullptr && robot::is_robot(skeleton_of(*slot.model));
  return is_on_robot || robot::is_robot(motion_of(slot).skeleton);
}

std::string wanted_of(const OptionInfo& info) {
  if (!info.wanted.empty()) return std::string(info.wanted);
  const bool is_count = info.type == OptionType::Count;
  if (!is_count && info.type != OptionType::Number) return std::string(info.value_name);
  const std::string kind = is_count ? "a whole number" : "a number";
  const bool has_most = info.most < std::numeric_limits<double>::max();
  const std::string most = has_most ? fmt::format("{}", info.most) : "";
  if (info.least > 0 && info.least <= std::numeric_limits<double>::min()) {
    return kind + " above 0" + (has_most ? ", at most " + most : "");
  }
  const bool has_least = info.least > std::numeric_limits<double>::lowest();
  if (!has_least) return has_most ? kind + " of at most " + most : kind;
  return has_most ? fmt::format("{} from {} to {}", kind, info.least, most)
                  : fmt::format("{} of at least {}", kind, info.least);
}

std::string text_of(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

Result<Slot> open(const Session& session, const Opening& opening, Diagnostics& diagnostics) {
  Slot slot;
  slot.opening = opening;
  auto options = read_options(opening);
  if (!options) return fail(std::move(options.error()));
  auto model = read_model(session.files, slot, *options, diagnostics);
  if (!model) return fail(std::move(model.error()));
  slot.model = std::move(*model);
  options->skeleton = slot.model;
  options->skeleton_name = opening.skeleton;
  const Format* format = opening.from.empty() ? nullptr : find_format(opening.from);
  auto document =
      read(session.files, opening.path, format, std::move(*options), slot.opened, diagnostics);
  if (!document) return fail(std::move(document.error()));
  slot.source = slot.current = std::move(*document);
  slot.clock = clock_of(slot.source);
  auto placed = place_current(session, slot, diagnostics);
  if (!placed) return fail(std::move(placed.error()));
  slot.noticed = diagnostics;
  return slot;
}

std::optional<Opening> lenient_opening(const Session& session, const Opening& failed,
                                       const Error& error) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 25;  // a second or two
  const auto file = session.files.find(failed.path);
  const bool is_of_content =
      error.kind == ErrorKind::InvalidInput || error.kind == ErrorKind::DataLoss;
  if (!is_of_content || is_lenient(failed) || file == session.files.end()) return std::nullopt;
  Opening lenient = failed;
  lenient.options["lenient"] = true;
  Diagnostics ignored;
  const bool opens = file->second->size() > kMostBytes || open(session, lenient, ignored);
  return opens ? std::optional(std::move(lenient)) : std::nullopt;
}

Result<void> apply_steps(const Session& session, Slot& slot, const Json& steps,
                         Diagnostics& diagnostics) {
  Slot changed = slot;
  changed.current = changed.source;
  changed.source_frames.clear();
  changed.clock = clock_of(changed.source);
  for (const Json& step : steps) {
    changed.source_frames.clear();
    const auto warping = step.find("warp");
    auto applied = warping != step.end()
                       ? warp(changed, *warping, diagnostics)
                       : operate(session, changed, text_of(step, "operation"), diagnostics);
    if (!applied) return applied;
  }
  auto placed = place_current(session, changed, diagnostics);
  if (placed) slot = std::move(changed);
  return placed;
}

}  // namespace kinefile::page
