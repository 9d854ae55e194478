// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>

#include "command.hpp"
#include "report.hpp"

namespace kinefile::cli {
namespace {

struct Convert {
  std::string in;
  std::string out;
  std::string to;
  std::string order;
  std::string channels = "as-is";
  std::optional<int> decimals;
  bool may_replace = false;
  Reading reading;
};

int report(const Error& error, const Globals& globals) {
  print_error(error, globals);
  return exit_code_of(error);
}

/// Gives the motion the channels that were asked for.
Result<void> change_channels(const Convert& convert, Document& document, Diagnostics& diagnostics) {
  ChannelOptions options;
  options.lenient = convert.reading.is_lenient;
  const auto kept = document.extras.file.find("positions");
  options.adds_positions = kept != document.extras.file.end() && kept->second == "add";
  if (!convert.order.empty()) options.order = parse_rotation_order(convert.order);
  if (convert.channels == "root") options.positions = PositionChannels::Root;
  if (convert.channels == "all") options.positions = PositionChannels::All;
  if (!options.order && options.positions == PositionChannels::AsIs) return {};
  const Motion* motion = std::get_if<Motion>(&document.content);
  auto changed = with_channels(motion != nullptr ? *motion : Motion{skeleton_of(document), {}},
                               options, diagnostics);
  if (!changed) return fail(std::move(changed.error()));
  if (motion != nullptr) {
    document.content = std::move(*changed);
  } else {
    document.content = std::move(changed->skeleton);
  }
  return {};
}

int run(const Convert& convert, const Globals& globals) {
  const Format* format = convert.to.empty() ? format_of_name(convert.out) : find_format(convert.to);
  if (format == nullptr) {
    return usage_error(globals,
                       fmt::format("'{}' shows no format by its name; --to names it", convert.out));
  }
  int exit_code = kDone;
  auto document = load(convert.in, convert.reading, globals, exit_code);
  if (!document) return exit_code;
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = convert.reading.is_strict;
  auto result = change_channels(convert, *document, diagnostics);
  if (result) {
    WriteOptions options;
    options.decimals = convert.decimals;
    result = write_file(convert.out, *document, *format, options, convert.may_replace, diagnostics);
  }
  print_diagnostics(stderr, diagnostics, globals);
  if (result) return kDone;
  if (result.error().place.source.empty()) result.error().place.source = convert.in;
  // What --strict made an error of has been printed already.
  return diagnostics.has_errors() ? exit_code_of(result.error()) : report(result.error(), globals);
}

std::string check_order(const std::string& text) {
  return parse_rotation_order(text) ? "" : "expected three axes such as ZXY";
}

std::vector<std::string> writable_formats() {
  std::vector<std::string> names;
  for (const Format& format : formats()) {
    if (format.write != nullptr) names.emplace_back(format.name);
  }
  return names;
}

}  // namespace

void add_convert(CLI::App& app, Globals& globals) {
  auto convert = std::make_shared<Convert>();
  CLI::App* command = app.add_subcommand("convert", "Write a file in another format");
  command->add_option("IN", convert->in, "File to read; - is standard input")->required();
  command->add_option("OUT", convert->out, "File to write; - is standard output")->required();
  command->add_option("--to", convert->to, "Format of the output; else its name tells")
      ->check(CLI::IsMember(writable_formats()))
      ->type_name("FORMAT");
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
      ->add_option("--decimals", convert->decimals,
                   "Digits after the point; else as many as the exact value needs")
      ->check(CLI::Range(0, 30))
      ->type_name("N");
  command->add_flag("--force", convert->may_replace, "Replace an existing file");
  add_reading_options(*command, convert->reading);
  command->callback([convert, &globals] {
    globals.run = [convert, &globals] { return run(*convert, globals); };
  });
}

}  // namespace kinefile::cli
