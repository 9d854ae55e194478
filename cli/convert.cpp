// SPDX-License-Identifier: MIT
#include <memory>
#include <utility>

#include "command.hpp"
#include "options.hpp"
#include "writing.hpp"

namespace kinefile::cli {
namespace {

struct Convert {
  std::string in;
  std::string order;
  std::string channels = "as-is";
  std::string style = "as-is";
  Writing writing;
  Reading reading;
};

/// The channels that were asked for.
shape::ChannelOptions channels_of(const Convert& convert) {
  shape::ChannelOptions options;
  if (!convert.order.empty()) options.order = shape::parse_rotation_order(convert.order);
  if (convert.channels == "root") options.positions = shape::PositionChannels::Root;
  if (convert.channels == "all") options.positions = shape::PositionChannels::All;
  return options;
}

int run(Convert& convert, const Globals& globals) {
  const Format* format = output_format(convert.writing);
  if (format == nullptr) return no_output_format(convert.writing, globals);
  // The bytes of the input tell its encoding.
  if (has_option(format->write_options, "encoding")) {
    convert.writing.format.encoding = std::exchange(convert.reading.encoding, {});
  }
  if (convert.reading.in_degrees && convert.reading.project.empty()) {
    return usage_error(globals, "--degrees needs --project, which says what words mean");
  }
  int exit_code = kDone;
  auto document = load(convert.in, convert.reading, globals, exit_code);
  if (!document) return exit_code;
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = convert.reading.is_strict;
  convert.writing.channels = channels_of(convert);
  convert.writing.format.project = convert.reading.loaded_project;
  convert.writing.format.in_degrees = convert.reading.in_degrees;
  convert.writing.format.is_relative = convert.reading.is_relative;
  if (convert.style == "json") convert.writing.format.style = YamlStyle::Json;
  if (convert.style == "yaml") convert.writing.format.style = YamlStyle::Block;
  return write_document({}, std::move(*document), *format, convert.writing, convert.in,
                        convert.reading, diagnostics, globals);
}

std::string check_order(const std::string& text) {
  return shape::parse_rotation_order(text) ? "" : "expected three axes such as ZXY";
}

}  // namespace

void add_convert(CLI::App& app, Globals& globals) {
  auto convert = std::make_shared<Convert>();
  CLI::App* command = app.add_subcommand("convert", "Write a file in another format");
  command->add_option("IN", convert->in, "File to read; - is standard input")->required();
  command->add_option("OUT", convert->writing.out, "File to write; - is standard output")
      ->required();
  command->add_option("--order", convert->order, "Order of rotations, outermost first")
      ->check(check_order)
      ->type_name("ZXY|...");
  command
      ->add_option("--channels", convert->channels,
                   "Which joints have position channels: root, all, or as-is")
      ->check(CLI::IsMember({"root", "all", "as-is"}))
      ->default_str("as-is")
      ->type_name("WHICH");
  command
      ->add_option("--form", convert->writing.form,
                   "Of a body motion (.seq): the poses of all links, the root's pose and all "
                   "joints, or both")
      ->check(CLI::IsMember({"links", "joints", "both"}))
      ->type_name("FORM");
  command
      ->add_option("--robot", convert->writing.robot,
                   "The robot that a motion goes onto, where --skeleton names the motion's own "
                   "skeleton (.amc)")
      ->type_name("FILE");
  command
      ->add_option("--map", convert->writing.joint_map,
                   "A YAML file that says which joint of a motion each joint of a robot follows, "
                   "where their names differ")
      ->type_name("FILE");
  command
      ->add_option("--flow-format", convert->writing.flow_format,
                   "Of a flow of servo poses: word_n (RobovieMaker for VS-RC003) or v1r4 "
                   "(RobovieMaker2)")
      ->check(CLI::IsMember({"word_n", "v1r4"}))
      ->type_name("FORMAT");
  command
      ->add_option("--up", convert->writing.up,
                   "The axis that points up in the output: z is usual for .seq, y for others")
      ->check(CLI::IsMember({"y", "z", "as-is"}))
      ->type_name("AXIS");
  command
      ->add_option("--seq-version", convert->writing.format.seq_version,
                   "Format version of a .seq output; else the file's own, or 2")
      ->check(CLI::Range(1, 4))
      ->type_name("N");
  command
      ->add_option("--se3-format", convert->writing.format.se3_format,
                   "How a .seq output writes poses; else as the file does, or XYZQWQXQYQZ")
      ->check(CLI::IsMember({"XYZQWQXQYQZ", "XYZQXQYQZQW", "XYZRPY"}))
      ->type_name("FORMAT");
  command
      ->add_option("--style", convert->style,
                   "Layout of a .seq output: yaml, json (all in flow style), or as the file's")
      ->check(CLI::IsMember({"yaml", "json", "as-is"}))
      ->type_name("STYLE");
  command->add_flag("--choreonoid-digits", convert->writing.format.choreonoid_digits,
                    "Nine significant digits in a .seq output, as Choreonoid writes");
  auto* degrees = command->add_flag("--degrees", convert->reading.in_degrees,
                                    "Words of a flow's table are degrees, by --project");
  command->add_flag("--relative", convert->reading.is_relative, "Degrees from the base pose on")
      ->needs(degrees);
  add_writing_options(*command, convert->writing);
  add_reading_options(*command, convert->reading);
  command->callback([convert, &globals] {
    globals.run = [convert, &globals] { return run(*convert, globals); };
  });
}

}  // namespace kinefile::cli
