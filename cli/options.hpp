// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "command.hpp"

namespace kinefile::cli {

/// A flag that is made from tables of options. If several formats have an option with the same
/// name, it is one flag, which sets it for all of them.
struct TableFlag {
  OptionInfo info;
  std::string help;  ///< the help texts of all formats
  /// Whether options accept a word, and what sets them; one of each per option.
  std::vector<std::function<bool(const std::string&word)>> checks, setters;
};

/// Adds the options of a table to flags. `target` must outlive them.
template <class Target>
void add_table(std::vector<TableFlag>& flags, std::span<const Option<Target>> table,
               Target& target) {
  for (const Option<Target>& option : table) {
    if (option.set == nullptr) continue;  // a file option, which the command reads
    auto flag = std::find_if(flags.begin(), flags.end(), [&option](const TableFlag& known) {
      return known.info.name == option.info.name;
    });
    if (flag == flags.end())
      flag = flags.insert(flags.end(), {option.info, std::string(option.info.help), {}, {}});
    if (flag->help.find(option.info.help) == std::string::npos) {
      flag->help += fmt::format(". {}", option.info.help);
    }
    flag->checks.emplace_back([option](const std::string& word) {
      Target scratch;
      return option.set(scratch, option.info, word);
    });
    flag->setters.emplace_back([option, &target](const std::string& word) {
      return option.set(target, option.info, word);
    });
  }
}

/// Adds a flag to a command, unless it has one with that name.
void add_flag(CLI::App& command, const TableFlag& flag);

/// Adds a flag for every option of a table to a command. `target` must outlive it.
template <class Target>
void add_flags(CLI::App& command, std::span<const Option<Target>> table, Target& target) {
  std::vector<TableFlag> flags;
  add_table(flags, table, target);
  for (const TableFlag& flag : flags) add_flag(command, flag);
}

/// Refuses the first given option that has no effect on any of the files that were read and on any
/// output, by the tables of options of their formats.
/// \param outputs  the formats of the outputs
/// \errors CLI003 (Usage)
Result<void> expect_options_of(const Reading& reading, std::span<const Format* const> outputs);

/// The same for the options that have an effect on tables of poses alone.
/// \errors CLI003 (Usage)
Result<void> expect_pose_options_of(const Reading& reading, std::span<const Format* const> outputs);

/// Refuses --skeleton if it was not read.
/// \errors CLI003 (Usage)
Result<void> expect_skeleton_used(const Reading& reading);

/// Checks both, at the end of a command that writes no document; errors are reported.
/// \returns the worse of the given exit code and that of the checks
int finish_reading(const Reading& reading, const Globals& globals, int exit_code);

}  // namespace kinefile::cli
