// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>

#include "command.hpp"
#include "json_output.hpp"

namespace kinefile::cli {
namespace {

template <class Target>
Json names_of(std::span<const Option<Target>> table) {
  Json names = Json::array();
  for (const Option<Target>& option : table) names.push_back(option.info.name);
  return names;
}

int run(bool is_json) {
  Json all = Json::array();
  if (!is_json)
    print_data(fmt::format("{:<12}{:<6}{:<24}{}\n", "FORMAT", "DOES", "NAMES", "WHAT IT IS"));
  for (const Format& format : formats()) {
    const bool is_read = format.read != nullptr;
    const bool has_writer = is_written(format);
    const bool has_poses = format.write_poses != nullptr;
    if (is_json) {
      all.push_back({{"name", format.name},
                     {"reads", is_read},
                     {"writes", has_writer},
                     {"writes_poses", has_poses},
                     {"extensions", format.extensions},
                     {"read_options", names_of(format.read_options)},
                     {"write_options", names_of(format.write_options)},
                     {"pose_options", names_of(format.pose_options)},
                     {"description", format.description}});
      continue;
    }
    std::string extensions;
    for (const std::string_view extension : format.extensions) {
      extensions += fmt::format("{}{}", extensions.empty() ? "" : " ", extension);
    }
    print_data(fmt::format(
        "{:<12}{:<6}{:<24}{}\n", format.name,
        fmt::format("{}{}{}", is_read ? "r" : "-", has_writer ? "w" : "-", has_poses ? "p" : "-"),
        extensions, format.description));
  }
  if (is_json) print_json(all);
  return kDone;
}

}  // namespace

void add_formats(CLI::App& app, Globals& globals) {
  auto is_json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand(
      "formats", "List what can be read (r), written (w), and written by fk (p)");
  command->add_flag("--json", *is_json, "Print an array with an object a format");
  command->callback([is_json, &globals] { globals.run = [is_json] { return run(*is_json); }; });
}

}  // namespace kinefile::cli
