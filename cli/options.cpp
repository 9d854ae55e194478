// SPDX-License-Identifier: MIT
#include "options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "report.hpp"

namespace kinefile::cli {
namespace {

std::string listed(const std::vector<std::string_view>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 < names.size() ? ", " : " and ";
    text += names[i];
  }
  return text;
}

bool reads_with(const Format& format, std::string_view option) {
  return find_option(format.read_options, option) != nullptr;
}

/// Whether an option has an effect on a conversion to a format.
bool writes_with(const Format& format, std::string_view option) {
  if (!is_written(format)) return false;
  if (find_option(format.write_options, option) != nullptr) return true;
  for (const AdaptOption& adapting : adapt_options()) {
    if (adapting.option.info.name == option) return adapting.is_for(format);
  }
  return false;
}

/// Whether an option has an effect on a table of poses.
bool writes_poses_with(const Format& format, std::string_view option) {
  return find_option(format.pose_options, option) != nullptr;
}

using Uses = bool (*)(const Format&, std::string_view option);

/// The formats on which an option has an effect.
std::vector<std::string_view> users_of(std::string_view option, Uses uses) {
  std::vector<std::string_view> names;
  for (const Format& format : formats()) {
    if (uses(format, option)) names.push_back(format.name);
  }
  return names;
}

/// Whether it has an effect on one of these.
bool is_used_by(std::span<const Format* const> all, std::string_view option, Uses uses) {
  return std::any_of(all.begin(), all.end(),
                     [option, uses](const Format* format) { return uses(*format, option); });
}

/// The formats that an option is for, and those that it was given for.
/// \param writes  how outputs use options
std::string refusal(std::string_view option, const Reading& reading,
                    std::span<const Format* const> outputs, Uses writes) {
  std::vector<std::string_view> from;
  std::vector<std::string_view> to;
  for (const Format* format : reading.formats) from.push_back(format->name);
  for (const Format* format : outputs) to.push_back(format->name);
  std::vector<std::string> uses;
  const auto readers = users_of(option, reads_with);
  const auto writers = users_of(option, writes);
  if (!readers.empty()) uses.push_back("reading " + listed(readers));
  if (!writers.empty()) uses.push_back("writing " + listed(writers));
  return fmt::format("--{} has no effect {}: it is for {}", option,
                     to.empty() ? fmt::format("on {}", listed(from))
                                : fmt::format("from {} to {}", listed(from), listed(to)),
                     fmt::join(uses, ", and for "));
}

/// Adds an option with a value to a command.
/// \param set  called with the word, or with each word of an option that can repeat
CLI::Option* add_with_value(CLI::App& command, const std::string& name, const std::string& help,
                            bool can_repeat, const std::function<void(const std::string&)>& set) {
  if (!can_repeat) return command.add_option_function<std::string>(name, set, help);
  const auto set_all = [set](const std::vector<std::string>& words) {
    for (const std::string& word : words) set(word);
  };
  return command.add_option_function<std::vector<std::string>>(name, set_all, help)
      ->allow_extra_args(false);
}

/// Adds the check that a flag's words are valid for all of its options.
void add_check(CLI::Option& option, const TableFlag& flag) {
  const OptionInfo& info = flag.info;
  if (info.type == OptionType::Choice) {
    option.check(CLI::IsMember(std::vector<std::string>(info.choices.begin(), info.choices.end())));
    return;
  }
  if (info.type == OptionType::Count && info.wanted.empty()) {
    constexpr double kMost = std::numeric_limits<int>::max();
    option.check(CLI::Range(static_cast<int>(std::max(info.least, -kMost)),
                            static_cast<int>(std::min(info.most, kMost))));
    return;
  }
  option.check([checks = flag.checks, wanted = info.wanted](const std::string& word) {
    for (const auto& is_valid : checks) {
      if (!is_valid(word)) return fmt::format("expected {}, found '{}'", wanted, word);
    }
    return std::string();
  });
}

Result<void> no_effect(std::string message) {
  return fail(ErrorKind::Usage, "CLI003", std::move(message));
}

}  // namespace

void add_flag(CLI::App& command, const TableFlag& flag) {
  const OptionInfo& info = flag.info;
  const std::string name = fmt::format("--{}", info.name);
  if (command.get_option_no_throw(name) != nullptr) return;
  const auto set = [setters = flag.setters](const std::string& word) {
    for (const auto& setter : setters) setter(word);
  };
  if (info.type == OptionType::Flag) {
    command.add_flag_callback(
        name, [set] { set(""); }, flag.help);
    return;
  }
  CLI::Option* option = add_with_value(command, name, flag.help, info.can_repeat, set);
  option->type_name(std::string(info.value_name))->required(info.is_required);
  if (!info.default_word.empty()) option->default_str(std::string(info.default_word));
  add_check(*option, flag);
}

Result<void> expect_options_of(const Reading& reading, std::span<const Format* const> outputs) {
  if (reading.command == nullptr || reading.formats.empty()) return {};
  for (const CLI::Option* option : reading.command->get_options()) {
    if (option->count() == 0) continue;
    const std::string name = option->get_single_name();
    if (name == "skeleton") continue;  // checked by `expect_skeleton_used`
    const bool is_of_formats =
        !users_of(name, reads_with).empty() || !users_of(name, writes_with).empty();
    const bool has_use = !is_of_formats || is_used_by(reading.formats, name, reads_with) ||
                         is_used_by(outputs, name, writes_with);
    if (!has_use) return no_effect(refusal(name, reading, outputs, writes_with));
  }
  return {};
}

Result<void> expect_pose_options_of(const Reading& reading,
                                    std::span<const Format* const> outputs) {
  for (const CLI::Option* option : reading.command->get_options()) {
    if (option->count() == 0) continue;
    const std::string name = option->get_single_name();
    const bool has_use =
        users_of(name, writes_poses_with).empty() || is_used_by(outputs, name, writes_poses_with);
    if (!has_use) return no_effect(refusal(name, reading, outputs, writes_poses_with));
  }
  return {};
}

Result<void> expect_skeleton_used(const Reading& reading) {
  if (reading.skeleton.empty() || reading.is_skeleton_used || reading.formats.empty()) return {};
  return no_effect(
      fmt::format("--skeleton {} has no effect: nothing here needs a skeleton", reading.skeleton));
}

int finish_reading(const Reading& reading, const Globals& globals, int exit_code) {
  auto effect = expect_options_of(reading, {});
  if (effect) effect = expect_skeleton_used(reading);
  if (effect) return exit_code;
  print_error(effect.error(), globals);
  return worse(exit_code, kUsage);
}

}  // namespace kinefile::cli
