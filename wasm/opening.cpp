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

const Format* format_of(const FileSet& files, const std::string& path) {
  const std::string_view bytes = view(*files.at(path));
  return detect_format(bytes.substr(0, kHeadBytes), path);
}

bool is_robot(const Slot& slot) {
  const Skeleton* skeleton = std::get_if<Skeleton>(&slot.source.content);
  return skeleton != nullptr && robot::is_robot(*skeleton);
}

bool wants_robot(const Slot& slot) {
  return slot.model == nullptr && std::holds_alternative<BodyMotion>(slot.source.content);
}

/// Opens a document with what it needs of the helpers. A file of a format that finds its companion
/// by itself needs none; another one that cannot be read with the robot is read without it.
Result<Slot> open_with(const Session& session, const std::string& path, const Format& format,
                       const Helpers& helpers, Diagnostics& diagnostics) {
  const Opening plain{.path = path};
  const bool needs_none = !format.companion.empty() || helpers.robot.empty();
  if (needs_none) return open(session, plain, diagnostics);
  Opening opening = plain;
  opening.skeleton = helpers.robot;
  opening.servo_map = helpers.servo_map;
  opening.project = helpers.project;
  auto slot = open(session, opening, diagnostics);
  if (slot) return slot;
  Diagnostics alone;
  auto without = open(session, plain, alone);
  if (without) diagnostics = std::move(alone);
  return without ? std::move(without) : std::move(slot);
}

Opened open_one(Session& session, const std::string& path, const Format& format,
                const Helpers& helpers) {
  Opened opened{.path = path, .format = std::string(format.name)};
  auto slot = open_with(session, path, format, helpers, opened.diagnostics);
  if (!slot) {
    opened.what = Opened::What::Fault;
    if (!opened.diagnostics.has_errors()) opened.diagnostics.add(slot.error());
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

/// Whether a file is of a format that is read and not written: those of robots' models.
bool is_model(const FileSet& files, const std::string& path) {
  const Format* format = format_of(files, path);
  return format != nullptr && format->read != nullptr && !is_written(*format);
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
void give_robot(Session& session, const std::string& robot) {
  for (auto& [handle, slot] : session.slots) {
    if (robot.empty() || !wants_robot(slot)) continue;
    Opening opening = slot.opening;
    opening.skeleton = robot;
    Diagnostics ignored;
    if (auto again = open(session, opening, ignored)) slot = std::move(*again);
  }
}

}  // namespace

std::vector<Opened> open_all(Session& session, std::vector<std::string> paths, std::size_t most) {
  std::vector<Opened> all;
  Helpers helpers = helpers_of(session.files);
  // Models first, since body motions and flows are placed on them.
  std::stable_partition(paths.begin(), paths.end(),
                        [&](const std::string& path) { return is_model(session.files, path); });
  std::size_t num_open = 0;
  for (const std::string& path : paths) {
    const Format* format = format_of(session.files, path);
    Opened other{.path = path};
    if (path == helpers.project || path == helpers.servo_map || is_companion(session, path)) {
      other.what = Opened::What::Companion;
    } else if (format == nullptr || format->read == nullptr) {
      other.what = Opened::What::Unknown;
    } else if (num_open >= most) {
      other.what = Opened::What::Waiting;
      other.format = format->name;
    } else {
      helpers.robot = is_written(*format) ? robot_of(session) : std::string();
      other = open_one(session, path, *format, helpers);
      if (other.what == Opened::What::Document) ++num_open;
    }
    all.push_back(std::move(other));
  }
  give_robot(session, robot_of(session));
  fold_companions(session, all);
  return all;
}

}  // namespace kinefile::page
