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
  std::string robot, servo_map, project;
};

constexpr std::size_t kHeadBytes = std::size_t{1} << 16;

bool is_servo_map(const FileSet& files, const std::string& path) {
  const std::string name = lowered(path);
  if (!name.ends_with(".yaml") && !name.ends_with(".yml")) return false;
  Diagnostics ignored;
  return parse_servo_map(view(*files.at(path)), path, ignored).has_value();
}

bool is_project(const FileSet& files, const std::string& path) {
  if (!lowered(path).ends_with(".rpj")) return false;
  std::set<std::string> opened;
  ReadOptions options;
  options.source_name = path;
  options.companions = files_beside(files, path, opened);
  Diagnostics ignored;
  return read_project(view(*files.at(path)), options, ignored).has_value();
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

bool wants_robot(const Slot& slot) {
  return slot.model == nullptr && std::holds_alternative<BodyMotion>(slot.source.content);
}

/// The ways to open a document with what it needs of the helpers, the best one first. A file of a
/// format that finds its companion by itself needs none; another one that cannot be read with the
/// robot is read without it.
std::vector<Opening> openings_with(const std::string& path, const Format& format,
                                   const Helpers& helpers) {
  const Opening plain{.path = path};
  if (!format.companion.empty() || helpers.robot.empty()) return {plain};
  Opening opening = plain;
  opening.skeleton = helpers.robot;
  opening.servo_map = helpers.servo_map;
  opening.project = helpers.project;
  return {opening, plain};
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

/// Closes skeletons that other documents were read with, whenever they were opened.
void fold_companions(Session& session, std::vector<Opened>& all) {
  std::set<std::string> used;
  for (const auto& [handle, slot] : session.slots) {
    used.insert(slot.opened.begin(), slot.opened.end());
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
    if (is_project(files, path)) helpers.project = path;
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

/// The path of the robot that was opened last, by itself or under a motion; empty if there is none.
std::string robot_of(const Session& session) {
  std::string path;
  for (const auto& [handle, slot] : session.slots) {
    if (is_robot(slot)) path = slot.opening.path;
    const bool is_carried = slot.model != nullptr && robot::is_robot(skeleton_of(*slot.model));
    if (is_carried) path = slot.opening.skeleton;
  }
  return path;
}

/// Reads the body motions that have no robot again, with the robot.
void give_robot(Session& session, const std::string& robot, std::set<int>& changed) {
  for (auto& [handle, slot] : session.slots) {
    if (robot.empty() || !wants_robot(slot)) continue;
    Opening opening = slot.opening;
    opening.skeleton = robot;
    Diagnostics ignored;
    auto again = open(session, opening, ignored);
    if (!again) continue;
    slot = std::move(*again);
    changed.insert(handle);
  }
}

/// Files that are being opened, and what came of them so far.
struct Work {
  Session& session;
  Helpers helpers;
  OpenedFiles done;
};

/// Whether another file is read with this one.
bool is_taken(const Work& work, const std::string& path) {
  return path == work.helpers.project || path == work.helpers.servo_map ||
         is_companion(work.session, path);
}

Opened open_now(Work& work, const std::string& path) {
  const Format& format = *format_of(work.session.files, path);
  work.helpers.robot = is_written(format) ? robot_of(work.session) : std::string();
  return open_one(work.session, path, format, work.helpers);
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

OpenedFiles open_all(Session& session, const std::vector<std::string>& paths, std::size_t few) {
  constexpr std::size_t kMostModels = 8;
  Work work{session, helpers_of(session.files), {}};
  std::map<Role, std::vector<std::string>> of_role;
  for (const std::string& path : paths) {
    const Role role = role_of(format_of(session.files, path));
    const bool is_used = role == Role::None && is_taken(work, path);
    const auto what = is_used ? Opened::What::Companion : Opened::What::Unknown;
    if (role == Role::None) work.done.files.push_back({.path = path, .what = what});
    if (role != Role::None) of_role[role].push_back(path);
  }
  // Models first, since body motions and flows are placed on them.
  open_up_to(work, of_role[Role::Model], kMostModels);
  const std::vector<std::string> motions = motions_of(work, of_role[Role::Motion]);
  const bool are_few = motions.size() <= few;
  open_up_to(work, motions, are_few ? few : 1);
  // Skeletons last: by then it is known which of them motions are read with. Beside many motions
  // the others belong to those that wait.
  if (are_few) {
    open_up_to(work, of_role[Role::Skeleton], kMostModels);
  } else {
    for (const std::string& path : of_role[Role::Skeleton]) {
      work.done.files.push_back({.path = path, .what = Opened::What::Companion});
    }
  }
  give_robot(session, robot_of(session), work.done.changed);
  fold_companions(session, work.done.files);
  for (const Opened& opened : work.done.files) {
    if (opened.handle != 0) work.done.changed.insert(opened.handle);
  }
  return std::move(work.done);
}

}  // namespace kinefile::page
