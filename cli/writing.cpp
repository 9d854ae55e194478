// SPDX-License-Identifier: MIT
#include "writing.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "options.hpp"
#include "report.hpp"
#include "signals.hpp"
#include "skeleton_source.hpp"

namespace kinefile::cli {
namespace {

std::vector<std::string> writable_formats() {
  std::vector<std::string> names;
  for (const Format& format : formats()) {
    if (is_written(format)) names.emplace_back(format.name);
  }
  return names;
}

/// Whether an option is also an option for reading, for example an encoding.
bool is_of_reading(std::string_view option) {
  const auto all = formats();
  return std::any_of(all.begin(), all.end(), [option](const Format& format) {
    return find_option(format.read_options, option) != nullptr;
  });
}

}  // namespace

void add_writing_options(CLI::App& command, Writing& writing) {
  command.add_option("--to", writing.to, "Format of the output; else its name tells")
      ->check(CLI::IsMember(writable_formats()))
      ->type_name("FORMAT");
  std::vector<TableFlag> flags;
  for (const Format& format : formats()) {
    if (is_written(format)) add_table(flags, format.write_options, writing.format);
  }
  for (const TableFlag& flag : flags) {
    if (!is_of_reading(flag.info.name)) add_flag(command, flag);
  }
  command.add_flag("--force", writing.may_replace, "Replace an existing file");
}

void add_adapting_options(CLI::App& command, Writing& writing, Reading& reading) {
  std::vector<TableFlag> flags;
  for (const AdaptOption& adapting : adapt_options()) {
    add_table(flags, std::span(&adapting.option, 1), writing.adapting);
  }
  // An option that output and input share is one flag for both.
  for (const Format& format : formats()) {
    add_table(flags, format.write_options, writing.format);
  }
  for (const Format& format : formats()) add_table(flags, format.read_options, reading.options);
  for (const AdaptOption& adapting : adapt_options()) {
    const OptionInfo& info = adapting.option.info;
    if (adapting.option.set != nullptr) continue;
    std::string& path = info.name == "map" ? writing.joint_map : writing.robot;
    command.add_option(fmt::format("--{}", info.name), path, std::string(info.help))
        ->type_name(std::string(info.value_name));
  }
  for (const TableFlag& flag : flags) add_flag(command, flag);
}

const Format* first_format(bool (*is_wanted)(const Format&)) {
  const auto all = formats();
  const auto found = std::find_if(all.begin(), all.end(), is_wanted);
  return found == all.end() ? nullptr : &*found;
}

const Format* output_format(const Writing& writing) {
  return writing.to.empty() ? format_of_name(writing.out) : find_format(writing.to);
}

int no_output_format(const Writing& writing, const Globals& globals) {
  return usage_error(globals,
                     fmt::format("'{}' shows no format by its name; --to names it", writing.out));
}

const Format* output_format(const Writing& writing, const std::string& source,
                            const Document& input) {
  if (!writing.to.empty()) return find_format(writing.to);
  const Format* const own = find_format(input.format);
  return writing.out == "-" ? own : format_of_output(writing.out, source, own);
}

namespace {

Result<JointMap> load_joint_map(const std::string& path, Diagnostics& diagnostics) {
  const auto bytes = FileBytes::open(path);
  if (!bytes) return fail(bytes.error());
  return parse_joint_map(bytes->view(), path, diagnostics);
}

}  // namespace

Result<AdaptOptions> adapting_options(const Writing& writing, const Reading& reading,
                                      Diagnostics& diagnostics) {
  AdaptOptions adapting = writing.adapting;
  adapting.channels.lenient = reading.is_lenient;
  adapting.kinds.lenient = reading.is_lenient;
  adapting.skeleton = source_of_skeleton(reading);
  adapting.skeleton_name = reading.skeleton;
  adapting.robot = source_of(writing.robot, reading);
  if (writing.joint_map.empty()) return adapting;
  auto map = load_joint_map(writing.joint_map, diagnostics);
  if (!map) return fail(std::move(map.error()));
  adapting.kinds.joint_map = std::move(*map);
  return adapting;
}

namespace {

Result<void> write_adapted(Document&& document, const Format& format, const Writing& writing,
                           const Reading& reading, Diagnostics& diagnostics) {
  const auto adapting = adapting_options(writing, reading, diagnostics);
  if (!adapting) return fail(adapting.error());
  WriteOptions options = writing.format;
  options.project = reading.loaded_project;
  auto adapted = adapt(std::move(document), format, *adapting, options, diagnostics);
  if (!adapted) return fail(std::move(adapted.error()));
  if (auto used = expect_skeleton_used(reading); !used) return used;
  return write_file(writing.out, *adapted, format, options, output_options(writing.may_replace),
                    diagnostics);
}

}  // namespace

int write_document(Result<void> made, Document&& document, const Format& format,
                   const Writing& writing, const std::string& source, const Reading& reading,
                   Diagnostics& diagnostics, const Globals& globals) {
  const Format* const output = &format;
  if (made) made = expect_options_of(reading, {&output, 1});
  if (made) made = write_adapted(std::move(document), format, writing, reading, diagnostics);
  print_diagnostics(STDERR_FILENO, diagnostics, globals);
  if (made) return kDone;
  return print_failure(std::move(made.error()), diagnostics, source, globals);
}

}  // namespace kinefile::cli
