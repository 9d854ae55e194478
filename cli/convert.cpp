// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>
#include <utility>

#include "command.hpp"
#include "long_motions.hpp"
#include "many.hpp"
#include "options.hpp"
#include "writing.hpp"

namespace kinefile::cli {
namespace {

struct Convert {
  std::string in;
  Many many;
  Writing writing;
  Reading reading;
};

/// The first bytes of a file; empty if it cannot be read.
std::optional<std::string> head_of(const std::string& path) {
  constexpr std::size_t kHeadBytes = std::size_t{1} << 16;
  if (const auto pieces = open_pieces(path)) {
    std::string head(std::min(kHeadBytes, pieces->size), '\0');
    return pieces->read(0, head) ? std::optional(std::move(head)) : std::nullopt;
  }
  const auto bytes = FileBytes::open(path);
  if (!bytes) return std::nullopt;
  return std::string(bytes->view().substr(0, kHeadBytes));
}

/// The format of the output before the input is read, which may depend on the input's content.
const Format* expected_format(const Convert& convert) {
  const Format* format = output_format(convert.writing);
  const bool is_asked_for = !convert.writing.to.empty() || convert.writing.out == "-";
  const bool depends_on_input = format == nullptr || !convert.reading.options.encoding.empty();
  if (is_asked_for || !depends_on_input) return format;
  const Format* input = find_format(convert.reading.from);
  if (const auto head = head_of(convert.in); head && input == nullptr) {
    input = detect_format(*head, convert.in);
  }
  return format_of_output(convert.writing.out, convert.in, input);
}

/// If the output format has an encoding, the option applies to it; the input's is detected.
void settle_encoding(const Format& output, Reading& reading) {
  if (find_option(output.write_options, "encoding") != nullptr) reading.options.encoding.clear();
}

int run_on_many(Convert& convert, const Globals& globals) {
  if (convert.writing.to.empty()) {
    return usage_error(globals, "--out-dir needs --to, the format of the outputs");
  }
  settle_encoding(*find_format(convert.writing.to), convert.reading);
  return run_many_documents(convert.many, convert.reading, convert.writing, {}, {}, {}, globals);
}

int run(Convert& convert, const Globals& globals) {
  if (globals.takes_many) return run_on_many(convert, globals);
  const Format* format = expected_format(convert);
  if (format == nullptr) return no_output_format(convert.writing, globals);
  settle_encoding(*format, convert.reading);
  if (const auto done =
          write_long(convert.in, *format, convert.writing, convert.reading, {}, globals)) {
    return *done;
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
  CLI::Option* out = nullptr;
  if (globals.takes_many) {
    add_inputs(*command, convert->many);
    out = command->add_option("-o,--out", convert->writing.out);
  } else {
    command->add_option("IN", convert->in, "File to read; - is standard input")->required();
    out = command->add_option("-o,--out,OUT", convert->writing.out,
                              "File to write; - is standard output");
    out->required();
  }
  add_many_options(*command, convert->many, {out});
  add_adapting_options(*command, convert->writing, convert->reading);
  add_writing_options(*command, convert->writing);
  add_reading_options(*command, convert->reading);
  command->get_option("--relative")->needs(command->get_option("--degrees"));
  command->callback([convert, &globals] {
    globals.run = [convert, &globals] { return run(*convert, globals); };
  });
}

}  // namespace kinefile::cli
