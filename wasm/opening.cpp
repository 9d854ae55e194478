// SPDX-License-Identifier: MIT
#include "opening.hpp"

#include <algorithm>
#include <utility>

#include "kinefile/io.hpp"
#include "kinefile/robot.hpp"
#include "kinefile/robot_project.hpp"
#include "kinefile/servo_map.hpp"

namespace kinefile::page {
namespace {

/// Files that belong to the motions of robots.
struct Helpers {
  std::vector<std::string> robots;  ///< the one to try first is the first
  std::string servo_map, project;
};

constexpr std::size_t kHeadBytes = std::size_t{1} << 16;

bool is_servo_map(const FileSet& files, const std::string& path) {
  const std::string name = lowered(path);
  if (!name.ends_with(".yaml") && !name.ends_with(".yml")) return false;
  Diagnostics ignored;
  return parse_servo_map(view(*files.at(path)), path, ignored).has_value();
}

bool is_named_as_project(const std::string& path) { return lowered(path).ends_with(".rpj"); }

/// Whether a project can be read, with the files beside it.
bool is_project(const FileSet& files, const std::string& path, Diagnostics& diagnostics) {
  if (!is_named_as_project(path)) return false;
  std::set<std::string> opened;
  ReadOptions options;
  options.source_name = path;
  options.companions = files_beside(files, path, opened);
  return read_project(view(*files.at(path)), options, diagnostics).has_value();
}

std::string_view head_of(const FileSet& files, const std::string& path) {
  return view(*files.at(path)).substr(0, kHeadBytes);
}

const Format* format_of(const FileSet& files, const std::string& path) {
  return detect_format(head_of(files, path), path);
}

bool is_robot(const Slot& slot) {
  const Skeleton* skeleton = std::get_if<Skeleton>(&slot.source.content);
  return skeleton != nullptr && robot::is_robot(*skeleton);
}

bool wants_helpers(const Slot& slot) {
  const bool wants_robot =
      slot.model == nullptr && std::holds_alternative<BodyMotion>(slot.source.content);
  return wants_robot || !slot.lacks.empty();
}

/// The ways to open a document with what it needs of the helpers, the best one first: with each
/// robot, and without one. A file of a format that finds its companion by itself needs none. A flow
/// that cannot be read with its helpers is at fault: without them it would seem to lack them.
std::vector<Opening> openings_with(const std::string& path, const Format& format,
                                   const Helpers& helpers) {
  const Opening plain{.path = path};
  if (!format.companion.empty()) return {plain};
  Opening opening = plain;
  if (format.conventions.writes.flows) {
    opening.servo_map = helpers.servo_map;
    opening.project = helpers.project;
  }
  std::vector<Opening> openings;
  for (const std::string& robot : helpers.robots) {
    openings.push_back(opening);
    openings.back().skeleton = robot;
  }
  const bool is_flow_alone = format.conventions.writes.flows && !openings.empty();
  if (!is_flow_alone) openings.push_back(opening);
  return openings;
}

/// Opens a document in the first way that succeeds; the failure is that of the best one.
Result<Slot> open_with(const Session& session, const std::vector<Opening>& openings,
                       Diagnostics& diagnostics) {
  auto best = open(session, openings.front(), diagnostics);
  if (best) return best;
  for (std::size_t i = 1; i < openings.size(); ++i) {
    Diagnostics own;
    auto slot = open(session, openings[i], own);
    if (!slot) continue;
    diagnostics = std::move(own);
    return slot;
  }
  return best;
}

std::optional<Opening> lenient_with(const Session& session, const std::vector<Opening>& openings,
                                    const Error& error) {
  for (const Opening& opening : openings) {
    if (auto lenient = lenient_opening(session, opening, error)) return lenient;
  }
  return std::nullopt;
}

/// Whether a file's name and content together say that it is meant for its format: endings that all
/// kinds of files have say nothing, and a table that begins with a time may be of anything.
bool is_meant_for(const FileSet& files, const std::string& path, const Format& format) {
  constexpr std::string_view kCommon[] = {".txt", ".csv", ".yaml", ".yml", ".json", ".xml"};
  const std::string name = lowered(path);
  const bool is_common =
      std::any_of(std::begin(kCommon), std::end(kCommon),
                  [&](std::string_view extension) { return name.ends_with(extension); });
  if (!is_common) return true;
  const bool is_shown = format.probe != nullptr && format.probe(head_of(files, path));
  return is_shown && !format.conventions.has_columns_of_components;
}

Opened open_one(Session& session, const std::string& path, const Format& format,
                const Helpers& helpers) {
  Opened opened{.path = path, .format = std::string(format.name)};
  const std::vector<Opening> openings = openings_with(path, format, helpers);
  auto slot = open_with(session, openings, opened.diagnostics);
  if (!slot) {
    const bool is_fault = is_meant_for(session.files, path, format);
    opened.what = is_fault ? Opened::What::Fault : Opened::What::Unknown;
    if (!opened.diagnostics.has_errors()) opened.diagnostics.add(slot.error());
    if (is_fault) opened.leniently = lenient_with(session, openings, slot.error());
    return opened;
  }
  opened.what = Opened::What::Document;
  opened.handle = session.next_handle++;
  session.slots.emplace(opened.handle, std::move(*slot));
  return opened;
}

/// Closes skeletons that other documents were read with, whenever they were opened. The robot of a
/// flow that it cannot show yet stays open.
void fold_companions(Session& session, std::vector<Opened>& all) {
  std::set<std::string> used;
  for (const auto& [handle, slot] : session.slots) {
    for (const std::string& path : slot.opened) {
      if (slot.lacks.empty() || path != slot.opening.skeleton) used.insert(path);
    }
  }
  std::erase_if(session.slots, [&](const auto& entry) {
    const Slot& slot = entry.second;
    const bool is_still = std::holds_alternative<Skeleton>(slot.source.content);
    return is_still && used.contains(slot.opening.path);
  });
  for (Opened& opened : all) {
    const bool is_open = session.slots.contains(opened.handle);
    if (!used.contains(opened.path) || is_open) continue;
    opened.what = Opened::What::Companion;
    opened.handle = 0;
  }
}

/// The files of the set that belong to the motions of robots; the last of several.
Helpers helpers_of(const FileSet& files) {
  Helpers helpers;
  for (const auto& [path, bytes] : files) {
    Diagnostics ignored;
    if (is_project(files, path, ignored)) helpers.project = path;
    if (is_servo_map(files, path)) helpers.servo_map = path;
  }
  return helpers;
}

/// What files of a format hold.
enum class Role {
  None,      ///< nothing that is read
  Model,     ///< robots: these formats are read and not written
  Skeleton,  ///< a skeleton alone, for motions of another format
  Motion,
};

Role role_of(const Format* format) {
  if (format == nullptr || format->read == nullptr) return Role::None;
  if (!is_written(*format)) return Role::Model;
  const auto all = formats();
  const bool is_needed = std::any_of(all.begin(), all.end(), [format](const Format& other) {
    return other.companion == format->name;
  });
  return is_needed ? Role::Skeleton : Role::Motion;
}

bool is_companion(const Session& session, const std::string& path) {
  return std::any_of(session.slots.begin(), session.slots.end(),
                     [&](const auto& slot) { return slot.second.opened.contains(path); });
}

/// The paths of the robots that are open, by themselves or under a motion, the last one first.
std::vector<std::string> robots_of(const Session& session) {
  std::vector<std::string> paths;
  for (auto entry = session.slots.rbegin(); entry != session.slots.rend(); ++entry) {
    const Slot& slot = entry->second;
    const bool is_carried = slot.model != nullptr && robot::is_robot(skeleton_of(*slot.model));
    const std::string& path = is_carried ? slot.opening.skeleton : slot.opening.path;
    const bool is_new = std::find(paths.begin(), paths.end(), path) == paths.end();
    if ((is_carried || is_robot(slot)) && is_new) paths.push_back(path);
  }
  return paths;
}

/// The robots to try a motion with: those of the files that are being opened in their order, then
/// those that were open before.
std::vector<std::string> robots_among(const Session& session,
                                      const std::vector<std::string>& models,
                                      const std::vector<std::string>& before) {
  const std::vector<std::string> now = robots_of(session);
  std::vector<std::string> robots;
  for (const std::string& path : models) {
    const bool is_open = std::find(now.begin(), now.end(), path) != now.end();
    if (is_open) robots.push_back(path);
  }
  robots.insert(robots.end(), before.begin(), before.end());
  return robots;
}

/// What a document was opened with, and the helpers that it lacks.
Opening completed(const Slot& slot, const std::string& robot, const Helpers& helpers) {
  Opening opening = slot.opening;
  if (opening.skeleton.empty()) opening.skeleton = robot;
  const bool is_flow = std::holds_alternative<PoseFlow>(slot.source.content);
  if (is_flow && opening.servo_map.empty()) opening.servo_map = helpers.servo_map;
  if (is_flow && opening.project.empty()) opening.project = helpers.project;
  return opening;
}

/// Whether a file is opened with the same other files.
bool are_same(const Opening& a, const Opening& b) {
  return a.skeleton == b.skeleton && a.servo_map == b.servo_map && a.project == b.project;
}

/// Reads the documents that lack a robot or another helper again, with it.
void give_helpers(Session& session, const Helpers& helpers, std::set<int>& changed) {
  std::vector<std::string> robots = helpers.robots;
  if (robots.empty()) robots.emplace_back();
  for (auto& [handle, slot] : session.slots) {
    if (!wants_helpers(slot)) continue;
    for (const std::string& robot : robots) {
      const Opening opening = completed(slot, robot, helpers);
      if (are_same(opening, slot.opening)) continue;
      Diagnostics ignored;
      auto again = open(session, opening, ignored);
      if (!again) continue;
      slot = std::move(*again);
      changed.insert(handle);
      break;
    }
  }
}

/// Files that are being opened, and what came of them so far.
struct Work {
  Session& session;
  Helpers helpers;
  OpenedFiles done;
};

/// Closes the robots among the files that are more than so many, so that they wait; all of them if
/// one is carried by a motion.
void keep_first_robots(Work& work, const std::vector<std::string>& models, std::size_t most) {
  const auto is_model = [&](const std::string& path) {
    return std::find(models.begin(), models.end(), path) != models.end();
  };
  const auto& slots = work.session.slots;
  const bool is_carried = std::any_of(slots.begin(), slots.end(), [&](const auto& entry) {
    return entry.second.lacks.empty() && is_model(entry.second.opening.skeleton);
  });
  std::size_t num_open = 0;
  for (Opened& opened : work.done.files) {
    if (opened.handle == 0 || !is_model(opened.path)) continue;
    if (!is_carried && num_open++ < most) continue;
    work.session.slots.erase(opened.handle);
    opened.what = Opened::What::Waiting;
    opened.handle = 0;
  }
}

/// Whether another file is read with this one.
bool is_taken(const Work& work, const std::string& path) {
  return path == work.helpers.project || path == work.helpers.servo_map ||
         is_companion(work.session, path);
}

/// What became of a file of no format: it may belong to others, or be a project at fault.
Opened unopened(const Work& work, const std::string& path) {
  Opened opened{.path = path};
  if (is_taken(work, path)) {
    opened.what = Opened::What::Companion;
  } else if (is_named_as_project(path) &&
             !is_project(work.session.files, path, opened.diagnostics)) {
    opened.what = Opened::What::Fault;
  }
  return opened;
}

Opened open_now(Work& work, const std::string& path) {
  const Format& format = *format_of(work.session.files, path);
  return open_one(work.session, path, format, is_written(format) ? work.helpers : Helpers());
}

/// Opens files one after the other until so many are open; after many that cannot be read the rest
/// is not tried either.
void open_up_to(Work& work, const std::vector<std::string>& paths, std::size_t most) {
  constexpr std::size_t kMostFaults = 8;
  std::size_t num_open = 0, num_faults = 0;
  for (const std::string& path : paths) {
    Opened opened{.path = path, .what = Opened::What::Companion};
    if (!is_taken(work, path)) {
      opened.what = Opened::What::Waiting;
      opened.format = format_of(work.session.files, path)->name;
      if (num_open < most && num_faults < kMostFaults) opened = open_now(work, path);
      num_open += opened.what == Opened::What::Document ? 1 : 0;
      num_faults += opened.what == Opened::What::Fault ? 1 : 0;
    }
    work.done.files.push_back(std::move(opened));
  }
}

/// The motions among files that may be some. Whether a file with an ending of all kinds of files is
/// one is known when it was read: what is none is done with.
std::vector<std::string> motions_of(Work& work, const std::vector<std::string>& paths) {
  std::vector<std::string> motions;
  for (const std::string& path : paths) {
    const FileSet& files = work.session.files;
    if (!is_taken(work, path) && !is_meant_for(files, path, *format_of(files, path))) {
      Opened tried = open_now(work, path);
      work.session.slots.erase(tried.handle);
      if (tried.what == Opened::What::Unknown) {
        work.done.files.push_back(std::move(tried));
        continue;
      }
    }
    motions.push_back(path);
  }
  return motions;
}

}  // namespace

OpenedFiles open_all(Session& session, const std::vector<std::string>& paths,
                     std::optional<std::size_t> few) {
  constexpr std::size_t kMostModels = 8;
  constexpr std::size_t kFew = 4;  // figures that a person tells apart at first sight
  const std::size_t most = few.value_or(kFew);
  Work work{session, helpers_of(session.files), {}};
  std::map<Role, std::vector<std::string>> of_role;
  for (const std::string& path : paths) {
    const Role role = role_of(format_of(session.files, path));
    if (role == Role::None) work.done.files.push_back(unopened(work, path));
    if (role != Role::None) of_role[role].push_back(path);
  }
  // Models first, since body motions and flows are placed on them: all, to see which one fits.
  const std::vector<std::string> before = robots_of(session);
  open_up_to(work, of_role[Role::Model], kMostModels);
  work.helpers.robots = robots_among(work.session, of_role[Role::Model], before);
  const std::vector<std::string> motions = motions_of(work, of_role[Role::Motion]);
  const bool are_few = motions.size() <= most;
  open_up_to(work, motions, are_few ? most : 1);
  // Skeletons last: by then it is known which of them motions are read with. Beside many motions
  // the others belong to those that wait.
  if (are_few) {
    open_up_to(work, of_role[Role::Skeleton], kMostModels);
  } else {
    for (const std::string& path : of_role[Role::Skeleton]) {
      work.done.files.push_back({.path = path, .what = Opened::What::Companion});
    }
  }
  give_helpers(session, work.helpers, work.done.changed);
  fold_companions(session, work.done.files);
  keep_first_robots(work, of_role[Role::Model], few.value_or(1));
  for (const Opened& opened : work.done.files) {
    if (opened.handle != 0) work.done.changed.insert(opened.handle);
  }
  return std::move(work.done);
}

}  // namespace kinefile::page
