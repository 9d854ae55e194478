// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "command.hpp"
#include "many.hpp"
#include "report.hpp"
#include "writing.hpp"

namespace kinefile::cli {
namespace {

struct Edit {
  std::string file;
  std::vector<std::string> words;
  Many many;
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

/// Whether a positional argument is an operation and not a file: its name is one's, or it can
/// hardly be meant as a file. So a file that is called reverse is given as ./reverse.
bool is_operation(const std::string& word) {
  const auto all = operations();
  const std::string name = word.substr(0, word.find('='));
  const bool is_named = std::any_of(
      all.begin(), all.end(), [&name](const OperationInfo& info) { return info.name == name; });
  std::error_code ignored;
  return is_named ||
         (name.find_first_of("./") == std::string::npos && !std::filesystem::exists(word, ignored));
}

int run_on_many(Edit& edit, const Globals& globals) {
  auto& inputs = edit.many.inputs;
  const auto middle = std::stable_partition(
      inputs.begin(), inputs.end(), [](const std::string& word) { return !is_operation(word); });
  edit.words.assign(middle, inputs.end());
  inputs.erase(middle, inputs.end());
  const auto operations = parse_operations(edit.words);
  if (!operations) return usage_error(globals, operations.error().message);
  if (inputs.empty()) return usage_error(globals, "no file is given");
  if (edit.words.empty()) return usage_error(globals, "no operation is given");
  const ManyChange change = [&operations](const ManyFile&, Document& document,
                                          const Reading& reading, Diagnostics& diagnostics) {
    return apply_all(*operations, document, reading, diagnostics);
  };
  return run_many_documents(edit.many, edit.reading, edit.writing, change, {}, edit.words, globals);
}

int run(Edit& edit, const Globals& globals) {
  if (globals.takes_many) return run_on_many(edit, globals);
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
  if (globals.takes_many) {
    add_inputs(*command, edit->many);
  } else {
    command->add_option("FILE", edit->file, "File to read; - is standard input")->required();
    command->add_option("OP", edit->words, list_of_operations())->required();
  }
  CLI::Option* out = command
                         ->add_option("-o,--out", edit->writing.out,
                                      "File to write; else standard output, in the input's format")
                         ->type_name("OUT");
  add_many_options(*command, edit->many, {out});
  add_writing_options(*command, edit->writing);
  add_reading_options(*command, edit->reading);
  command->callback(
      [edit, &globals] { globals.run = [edit, &globals] { return run(*edit, globals); }; });
}

}  // namespace kinefile::cli
