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

bool ends_in(const std::string& path, std::string_view extension) {
  return path.size() >= extension.size() &&
         std::equal(extension.rbegin(), extension.rend(), path.rbegin(),
                    [](char a, char b) { return a == (b >= 'A' && b <= 'Z' ? b - 'A' + 'a' : b); });
}

bool is_servo_map(const FileSet& files, const std::string& path) {
  if (!ends_in(path, ".yaml") && !ends_in(path, ".yml")) return false;
  Diagnostics ignored;
  return parse_servo_map(view(*files.at(path)), path, ignored).has_value();
}

bool is_project(const FileSet& files, const std::string& path) {
  if (!ends_in(path, ".rpj")) return false;
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

/// Opens a document, with what it needs of the helpers; a flow that lacks them is a fault.
Opened open_one(Session& session, const std::string& path, const Helpers& helpers) {
  Opened opened{.path = path};
  if (const Format* format = format_of(session.files, path)) opened.format = format->name;
  Opening opening{.path = path};
  const bool runs = !find_format(opened.format)->takes_skeleton;
  if (runs) {
    opening.skeleton = helpers.robot;
    opening.servo_map = helpers.servo_map;
    opening.project = helpers.project;
  }
  auto slot = open(session, opening, opened.diagnostics);
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

/// Closes documents that others were read with.
void fold_companions(Session& session, std::vector<Opened>& all) {
  std::set<std::string> used;
  for (const auto& [handle, slot] : session.slots) {
    used.insert(slot.opened.begin(), slot.opened.end());
  }
  for (Opened& opened : all) {
    const auto slot = session.slots.find(opened.handle);
    const bool is_still = slot != session.slots.end() &&
                          std::holds_alternative<Skeleton>(slot->second.source.content);
    const bool is_open = opened.what == Opened::What::Document;
    if (!used.contains(opened.path) || (is_open && !is_still)) continue;
    if (is_open) session.slots.erase(slot);
    opened.what = Opened::What::Companion;
    opened.handle = 0;
  }
}

/// Takes the files that belong to the motions of robots out of the list.
Helpers take_helpers(const FileSet& files, std::vector<std::string>& paths,
                     std::vector<Opened>& all) {
  Helpers helpers;
  std::vector<std::string> others;
  for (std::string& path : paths) {
    if (is_project(files, path)) {
      helpers.project = path;
    } else if (is_servo_map(files, path)) {
      helpers.servo_map = path;
    } else {
      others.push_back(std::move(path));
      continue;
    }
    all.push_back({.path = path, .what = Opened::What::Companion});
  }
  paths = std::move(others);
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

/// The path of the robot that was opened last; empty if there is none.
std::string robot_of(const Session& session) {
  std::string path;
  for (const auto& [handle, slot] : session.slots) {
    if (is_robot(slot)) path = slot.opening.path;
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
  Helpers helpers = take_helpers(session.files, paths, all);
  // Models first, since body motions and flows are placed on them.
  std::stable_partition(paths.begin(), paths.end(),
                        [&](const std::string& path) { return is_model(session.files, path); });
  std::size_t num_open = 0;
  for (const std::string& path : paths) {
    const Format* format = format_of(session.files, path);
    if (format == nullptr || format->read == nullptr) {
      all.push_back({.path = path});
      continue;
    }
    Opened other{.path = path, .format = std::string(format->name)};
    const bool is_still = is_model(session.files, path);
    if (!is_still) helpers.robot = robot_of(session);
    if (is_companion(session, path)) {
      other.what = Opened::What::Companion;
    } else if (num_open >= most) {
      other.what = Opened::What::Waiting;
    } else {
      other = open_one(session, path, helpers);
      if (!is_still && other.what == Opened::What::Document) ++num_open;
    }
    all.push_back(std::move(other));
  }
  give_robot(session, robot_of(session));
  fold_companions(session, all);
  return all;
}

}  // namespace kinefile::page
