// SPDX-License-Identifier: MIT
#include <memory>

#include "command.hpp"
#include "writing.hpp"

namespace kinefile::cli {
namespace {

struct Convert {
  std::string in;
  std::string order;
  std::string channels = "as-is";
  Writing writing;
  Reading reading;
};

/// The channels that were asked for.
ChannelOptions channels_of(const Convert& convert) {
  ChannelOptions options;
  if (!convert.order.empty()) options.order = parse_rotation_order(convert.order);
  if (convert.channels == "root") options.positions = PositionChannels::Root;
  if (convert.channels == "all") options.positions = PositionChannels::All;
  return options;
}

int run(Convert& convert, const Globals& globals) {
  const Format* format = output_format(convert.writing);
  if (format == nullptr) return no_output_format(convert.writing, globals);
  int exit_code = kDone;
  auto document = load(convert.in, convert.reading, globals, exit_code);
  if (!document) return exit_code;
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = convert.reading.is_strict;
  convert.writing.channels = channels_of(convert);
  return write_document({}, std::move(*document), *format, convert.writing, convert.in,
                        convert.reading, diagnostics, globals);
}

std::string check_order(const std::string& text) {
  return parse_rotation_order(text) ? "" : "expected three axes such as ZXY";
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
  add_writing_options(*command, convert->writing);
  add_reading_options(*command, convert->reading);
  command->callback([convert, &globals] {
    globals.run = [convert, &globals] { return run(*convert, globals); };
  });
}

}  // namespace kinefile::cli
