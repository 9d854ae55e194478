// SPDX-License-Identifier: MIT
#include "options.hpp"

#include <fmt/format.h>

#include <algorithm>

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

/// The formats in whose table an option stands.
std::vector<std::string_view> users_of(std::string_view option,
                                       std::span<const std::string_view> Format::*table) {
  std::vector<std::string_view> names;
  for (const Format& format : formats()) {
    if (has_option(format.*table, option)) names.push_back(format.name);
  }
  return names;
}

bool is_read_option(const Reading& reading, std::string_view option) {
  return std::any_of(
      reading.formats.begin(), reading.formats.end(),
      [option](const Format* format) { return has_option(format->read_options, option); });
}

/// What an option is for, and what it was given for.
std::string refusal(std::string_view option, const Reading& reading, const Format* output) {
  std::vector<std::string_view> inputs;
  for (const Format* format : reading.formats) inputs.push_back(format->name);
  std::vector<std::string> uses;
  const auto readers = users_of(option, &Format::read_options);
  const auto writers = users_of(option, &Format::write_options);
  if (!readers.empty()) uses.push_back("reading " + listed(readers));
  if (!writers.empty()) uses.push_back("writing " + listed(writers));
  return fmt::format("--{} has no effect {}: it is for {}", option,
                     output != nullptr ? fmt::format("from {} to {}", listed(inputs), output->name)
                                       : fmt::format("on {}", listed(inputs)),
                     fmt::join(uses, ", and for "));
}

Result<void> no_effect(std::string message) {
  return fail(ErrorKind::Usage, "CLI003", std::move(message));
}

}  // namespace

bool has_option(std::span<const std::string_view> table, std::string_view name) {
  return std::find(table.begin(), table.end(), name) != table.end();
}

Result<void> expect_options_of(const Reading& reading, const Format* output) {
  if (reading.command == nullptr || reading.formats.empty()) return {};
  for (const CLI::Option* option : reading.command->get_options()) {
    if (option->count() == 0) continue;
    const std::string name = option->get_single_name();
    if (name == "skeleton") continue;  // whose use shows; see `expect_skeleton_used`
    const bool is_of_formats = !users_of(name, &Format::read_options).empty() ||
                               !users_of(name, &Format::write_options).empty();
    const bool has_use = !is_of_formats || is_read_option(reading, name) ||
                         (output != nullptr && has_option(output->write_options, name));
    if (!has_use) return no_effect(refusal(name, reading, output));
  }
  return {};
}

Result<void> expect_skeleton_used(const Reading& reading) {
  if (reading.skeleton.empty() || reading.is_skeleton_used || reading.formats.empty()) return {};
  return no_effect(
      fmt::format("--skeleton {} has no effect: nothing here needs a skeleton", reading.skeleton));
}

int finish_reading(const Reading& reading, const Globals& globals, int exit_code) {
  auto effect = expect_options_of(reading, nullptr);
  if (effect) effect = expect_skeleton_used(reading);
  if (effect) return exit_code;
  print_error(effect.error(), globals);
  return worse(exit_code, kUsage);
}

}  // namespace kinefile::cli
