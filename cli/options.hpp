// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "command.hpp"

namespace kinefile::cli {

/// A flag that is made from tables of options. Formats may have an option of one name: it is one
/// flag, which sets it for all of them.
struct TableFlag {
  OptionInfo info;
  std::string help;  ///< of all of them
  std::vector<std::function<bool(const std::string& word)>> setters;
};

/// Adds the options of a table to flags. `target` must live as long as they.
template <class Target>
void add_table(std::vector<TableFlag>& flags, std::span<const Option<Target>> table,
               Target& target) {
  for (const Option<Target>& option : table) {
    if (option.set == nullptr) continue;  // a file: the command reads it
    auto flag = std::find_if(flags.begin(), flags.end(), [&option](const TableFlag& known) {
      return known.info.name == option.info.name;
    });
    if (flag == flags.end())
      flag = flags.insert(flags.end(), {option.info, std::string(option.info.help), {}});
    if (flag->help.find(option.info.help) == std::string::npos) {
      flag->help += fmt::format(". {}", option.info.help);
    }
    flag->setters.emplace_back([option, &target](const std::string& word) {
      return option.set(target, option.info, word);
    });
  }
}

/// Gives a command a flag, unless it has one of that name.
void add_flag(CLI::App& command, const TableFlag& flag);

/// Refuses the first option that was given and means nothing for the formats at hand, by their
/// tables of options: neither for a file that was read nor for the output.
/// \param output  the format of the output, or null
/// \errors CLI003 (Usage)
Result<void> expect_options_of(const Reading& reading, const Format* output);

/// Refuses --skeleton where nothing has read it.
/// \errors CLI003 (Usage)
Result<void> expect_skeleton_used(const Reading& reading);

/// Both, at the end of a command that writes no document; what is wrong is reported. Returns the
/// exit code, no better than the one given.
int finish_reading(const Reading& reading, const Globals& globals, int exit_code);

}  // namespace kinefile::cli
