// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "files.hpp"
#include "kinefile/fk.hpp"
#include "kinefile/process.hpp"
#include "kinefile/retime.hpp"
#include "kinefile/robot_project.hpp"

// The documents that the page has open.
namespace kinefile::page {

using Json = nlohmann::ordered_json;

/// What to open, and how.
struct Opening {
  std::string path;
  std::string from;       ///< the format's name; empty: detected
  std::string skeleton;   ///< a path: of the skeleton, or the robot; empty: found beside, or none
  std::string servo_map;  ///< a path, for a flow; empty: made from the project
  std::string project;    ///< a path, for a flow
  Json options = Json::object();  ///< words by the names in the formats' tables of read options
};

/// A pose of a flow as its robot takes it.
struct PlayedBlock {
  std::uint64_t tick = 0;  ///< when it begins; the frame of the robot's motion
  std::size_t number = 0;  ///< in the flow's file
  std::string name;        ///< empty where the flow's format has none
};

/// An open document. It is read once; steps are applied to a copy of what was read, so that any
/// list of steps can replace another.
struct Slot {
  Opening opening;
  std::shared_ptr<const Document> model;  ///< the skeleton or the robot; null: none
  Document source;                        ///< as read; a flow as a flow
  Document current;                       ///< after all steps
  Document played;                        ///< of a flow: the motion of its robot; else `current`
  FkTable table;                          ///< `current` in the world
  std::vector<double> source_frames;      ///< of the last step, if that is a warp; otherwise empty
  std::optional<Document> clock;          ///< the times of `source` that `current` shows, as a body
                                          ///< motion; absent: it has no frames, or not known
  std::vector<PlayedBlock> blocks;        ///< of a flow: its poses in the order of its run
  std::string lacks;                      ///< of a flow: why `played` has its sliders alone and
                                          ///< shows no figure; empty: it shows one
  std::set<std::string> opened;           ///< the companions that were read, by path
  Diagnostics noticed;                    ///< of reading and placing it
};

/// The files and the open documents.
struct Session {
  FileSet files;
  std::map<int, Slot> slots;
  int next_handle = 1;
};

/// Reads a document of the file set, and places it in the world.
/// \errors those of `read_bytes`, `place` and `fk`; IO001 (Io) if there is no such file; CLI001
///         (Usage) for an option that its formats do not have, or with an invalid word
Result<Slot> open(const Session& session, const Opening& opening, Diagnostics& diagnostics);

/// How a file opens leniently that could not be opened; nothing if leniency does not help. A file
/// that takes long to read is not tried, and is said to open.
/// \param failed  how it could not be opened
/// \param error   why not
std::optional<Opening> lenient_opening(const Session& session, const Opening& failed,
                                       const Error& error);

/// Applies steps to what was read, in order: {"operation": "trim=10:20"} or
/// {"warp": {"key": "150:160", "tail": "extend"}}. After an error nothing has changed.
/// \errors those of the operations, of `retime::warp_map`, `place` and `fk`
Result<void> apply_steps(const Session& session, Slot& slot, const Json& steps,
                         Diagnostics& diagnostics);

/// Reads the project that a slot's flow is for; null if it has none.
/// \errors IO001 (Io) if there is no such file; those of `read_project`
Result<std::shared_ptr<const RobotProject>> project_of(const Session& session, Slot& slot,
                                                       Diagnostics& diagnostics);

/// Gives the model of a slot; null if it has none. The slot need not outlive it.
DocumentSource source_of_model(const Slot& slot);

/// Whether a slot shows a robot: its model, or a motion on it.
bool is_of_robot(const Slot& slot);

/// The motion that a slot shows.
inline const Motion& motion_of(const Slot& slot) { return slot.table.placed.motion; }

/// The text of a member of an object; empty if there is none.
std::string text_of(const Json& object, const char* key);

/// What the word of an option has to be, with its limits: "a whole number from 0 to 17".
std::string wanted_of(const OptionInfo& info);

/// Sets options by the words of an object: true for a flag, an array for an option that is given
/// several times.
/// \param tables  tables of options; an option is set in each that has it
/// \errors CLI001 (Usage) if no table has an option, or its word is not valid
template <class Target>
Result<void> set_options(Target& target, const Json& words,
                         std::span<const std::span<const Option<Target>>> tables) {
  for (const auto& [name, given] : words.items()) {
    bool is_known = false;
    const Json list = given.is_array() ? given : Json::array({given});
    for (const auto& table : tables) {
      const Option<Target>* option = find_option(table, name);
      if (option == nullptr || option->set == nullptr) continue;
      is_known = true;
      for (const Json& word : list) {
        const std::string text = word.is_string() ? word.template get<std::string>() : "";
        if (word.is_boolean() && !word.template get<bool>()) continue;
        if (!option->set(target, option->info, text)) {
          return fail(
              ErrorKind::Usage, "CLI001",
              "--" + name + ": expected " + wanted_of(option->info) + ", found '" + text + "'");
        }
      }
    }
    if (!is_known) return fail(ErrorKind::Usage, "CLI001", "there is no option --" + name);
  }
  return {};
}

}  // namespace kinefile::page
