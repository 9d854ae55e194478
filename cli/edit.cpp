// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>

#include "command.hpp"
#include "report.hpp"
#include "writing.hpp"

namespace kinefile::cli {
namespace {

struct Edit {
  std::string file;
  std::vector<std::string> words;
  Writing writing;
  Reading reading;
};

/// The inputs of operations besides the document: other files, and the project.
Result<OperationContext> context_of(const Reading& reading, Diagnostics& diagnostics) {
  OperationContext context;
  context.lenient = reading.is_lenient;
  context.open = [&reading, &diagnostics](const std::string& name) {
    return load_quietly(name, reading, diagnostics);
  };
  auto project = load_project(reading, diagnostics);
  if (!project) return fail(std::move(project.error()));
  context.project = std::move(*project);
  return context;
}

Result<void> apply_all(const std::vector<Operation>& operations, Document& document,
                       const Reading& reading, Diagnostics& diagnostics) {
  const auto context = context_of(reading, diagnostics);
  if (!context) return fail(context.error());
  return apply(operations, document, *context, diagnostics);
}

int run(Edit& edit, const Globals& globals) {
  const auto operations = parse_operations(edit.words);
  if (!operations) return usage_error(globals, operations.error().message);
  int exit_code = kDone;
  auto document = load(edit.file, edit.reading, globals, exit_code);
  if (!document) return exit_code;
  const Format* format = output_format(edit.writing, edit.file, *document);
  if (format == nullptr) return no_output_format(edit.writing, globals);
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = edit.reading.is_strict;
  auto applied = apply_all(*operations, *document, edit.reading, diagnostics);
  return write_document(std::move(applied), std::move(*document), *format, edit.writing, edit.file,
                        edit.reading, diagnostics, globals);
}

}  // namespace

void add_edit(CLI::App& app, Globals& globals) {
  auto edit = std::make_shared<Edit>();
  edit->writing.out = "-";
  CLI::App* command =
      app.add_subcommand("edit", "Change a motion, by operations in the order given");
  command->add_option("FILE", edit->file, "File to read; - is standard input")->required();
  command->add_option("OP", edit->words, list_of_operations())->required();
  command
      ->add_option("-o,--out", edit->writing.out,
                   "File to write; else standard output, in the input's format")
      ->type_name("OUT");
  add_writing_options(*command, edit->writing);
  add_reading_options(*command, edit->reading);
  command->callback(
      [edit, &globals] { globals.run = [edit, &globals] { return run(*edit, globals); }; });
}

}  // namespace kinefile::cli
