// SPDX-License-Identifier: MIT
#include "writing.hpp"

#include <fmt/format.h>

#include "options.hpp"
#include "report.hpp"

namespace kinefile::cli {
namespace {

std::vector<std::string> writable_formats() {
  std::vector<std::string> names;
  for (const Format& format : formats()) {
    if (is_written(format)) names.emplace_back(format.name);
  }
  return names;
}

}  // namespace

void add_writing_options(CLI::App& command, Writing& writing) {
  command.add_option("--to", writing.to, "Format of the output; else its name tells")
      ->check(CLI::IsMember(writable_formats()))
      ->type_name("FORMAT");
  command
      .add_option("--decimals", writing.decimals,
                  "Digits after the point; else as many as the exact value needs")
      ->check(CLI::Range(0, 30))
      ->type_name("N");
  command.add_flag("--force", writing.may_replace, "Replace an existing file");
}

const Format* output_format(const Writing& writing) {
  return writing.to.empty() ? format_of_name(writing.out) : find_format(writing.to);
}

int no_output_format(const Writing& writing, const Globals& globals) {
  return usage_error(globals,
                     fmt::format("'{}' shows no format by its name; --to names it", writing.out));
}

const Format* output_format(const Writing& writing, const Document& input) {
  if (writing.out == "-" && writing.to.empty()) return find_format(input.format);
  return output_format(writing);
}

namespace {

KindOptions kind_options(const Writing& writing, const Reading& reading) {
  KindOptions options;
  options.lenient = reading.is_lenient;
  if (writing.form == "links") options.form = robot::BodyForm::Links;
  if (writing.form == "joints") options.form = robot::BodyForm::Joints;
  if (writing.form == "both") options.form = robot::BodyForm::Both;
  if (writing.flow_format == "word_n") options.flow_format = FlowFormat::WordN;
  if (writing.flow_format == "v1r4") options.flow_format = FlowFormat::V1R4;
  options.keeps_up = writing.up == "as-is";
  if (writing.up == "y") options.up = 1;
  if (writing.up == "z") options.up = 2;
  return options;
}

Result<JointMap> load_joint_map(const std::string& path, Diagnostics& diagnostics) {
  const auto bytes = FileBytes::open(path);
  if (!bytes) return fail(bytes.error());
  return parse_joint_map(bytes->view(), path, diagnostics);
}

/// The skeleton or robot that an option names, read when it is needed.
DocumentSource source_of(const std::string& path, const Reading& reading) {
  if (path.empty()) return {};
  return [path, &reading](Diagnostics& diagnostics) -> Result<std::shared_ptr<const Document>> {
    Reading of_robot = reading;
    of_robot.skeleton = path;
    const bool is_named = path == reading.skeleton;
    auto loaded = load_skeleton(is_named ? reading : of_robot, diagnostics);
    if (!loaded) return fail(std::move(loaded.error()));
    return std::make_shared<const Document>(std::move(**loaded));
  };
}

Result<AdaptOptions> adapt_options(const Writing& writing, const Reading& reading,
                                   Diagnostics& diagnostics) {
  AdaptOptions adapting;
  adapting.channels = writing.channels;
  adapting.channels.lenient = reading.is_lenient;
  adapting.kinds = kind_options(writing, reading);
  adapting.skeleton = source_of(reading.skeleton, reading);
  adapting.skeleton_name = reading.skeleton;
  adapting.robot = source_of(writing.robot, reading);
  if (writing.joint_map.empty()) return adapting;
  auto map = load_joint_map(writing.joint_map, diagnostics);
  if (!map) return fail(std::move(map.error()));
  adapting.kinds.joint_map = std::move(*map);
  return adapting;
}

Result<void> write_adapted(Document&& document, const Format& format, const Writing& writing,
                           const Reading& reading, Diagnostics& diagnostics) {
  const auto adapting = adapt_options(writing, reading, diagnostics);
  if (!adapting) return fail(adapting.error());
  WriteOptions options = writing.format;
  options.decimals = writing.decimals;
  auto adapted = adapt(std::move(document), format, *adapting, options, diagnostics);
  if (!adapted) return fail(std::move(adapted.error()));
  if (auto used = expect_skeleton_used(reading); !used) return used;
  return write_file(writing.out, *adapted, format, options, writing.may_replace, diagnostics);
}

}  // namespace

int write_document(Result<void> made, Document&& document, const Format& format,
                   const Writing& writing, const std::string& source, const Reading& reading,
                   Diagnostics& diagnostics, const Globals& globals) {
  if (made) made = expect_options_of(reading, &format);
  if (made) made = write_adapted(std::move(document), format, writing, reading, diagnostics);
  print_diagnostics(stderr, diagnostics, globals);
  if (made) return kDone;
  if (made.error().place.source.empty()) made.error().place.source = source;
  // What --strict made an error of has been printed already.
  if (!diagnostics.has_errors()) print_error(made.error(), globals);
  return exit_code_of(made.error());
}

}  // namespace kinefile::cli
