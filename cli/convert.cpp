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

/// The format of the output before the input is read, which may depend on the input's content.
const Format* expected_format(const Convert& convert) {
  const Format* format = output_format(convert.writing);
  const bool is_asked_for = !convert.writing.to.empty() || convert.writing.out == "-";
  const bool depends_on_input = format == nullptr || !convert.reading.options.encoding.empty();
  if (is_asked_for || !depends_on_input) return format;
  constexpr std::size_t kHeadBytes = std::size_t{1} << 16;
  const Format* input = find_format(convert.reading.from);
  if (const auto bytes = FileBytes::open(convert.in); bytes && input == nullptr) {
    input = detect_format(bytes->view().substr(0, kHeadBytes), convert.in);
  }
  return format_of_output(convert.writing.out, convert.in, input);
}

int run(Convert& convert, const Globals& globals) {
  const Format* format = expected_format(convert);
  if (format == nullptr) return no_output_format(convert.writing, globals);
  // If the output format has an encoding, the option applies to it; the input's encoding is
  // detected.
  if (find_option(format->write_options, "encoding") != nullptr) {
    convert.reading.options.encoding.clear();
  }
  int exit_code = kDone;
  auto document = load(convert.in, convert.reading, globals, exit_code);
  if (!document) return exit_code;
  format = output_format(convert.writing, convert.in, *document);
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
  command->add_option("-o,--out,OUT", convert->writing.out, "File to write; - is standard output")
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
