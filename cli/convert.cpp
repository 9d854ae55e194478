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
  Writing writing;
  Reading reading;
};

int run(Convert& convert, const Globals& globals) {
  const Format* format = output_format(convert.writing);
  if (format == nullptr) return no_output_format(convert.writing, globals);
  // If the output format has an encoding, the option applies to it; the input's encoding is
  // detected.
  if (find_option(format->write_options, "encoding") != nullptr) {
    convert.reading.options.encoding.clear();
  }
  int exit_code = kDone;
  auto document = load(convert.in, convert.reading, globals, exit_code);
  if (!document) return exit_code;
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = convert.reading.is_strict;
  return write_document({}, std::move(*document), *format, convert.writing, convert.in,
                        convert.reading, diagnostics, globals);
}

}  // namespace

void add_convert(CLI::App& app, Globals& globals) {
  auto convert = std::make_shared<Convert>();
  CLI::App* command = app.add_subcommand("convert", "Write a file in another format");
  command->add_option("IN", convert->in, "File to read; - is standard input")->required();
  command->add_option("OUT", convert->writing.out, "File to write; - is standard output")
      ->required();
  add_adapting_options(*command, convert->writing, convert->reading);
  add_writing_options(*command, convert->writing);
  add_reading_options(*command, convert->reading);
  command->get_option("--relative")->needs(command->get_option("--degrees"));
  command->callback([convert, &globals] {
    globals.run = [convert, &globals] { return run(*convert, globals); };
  });
}

}  // namespace kinefile::cli
